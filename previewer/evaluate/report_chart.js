// SPDX-License-Identifier: Apache-2.0
// The chart of error against time.
"use strict";
(() => {
  const { results, byId, colorOf, shapeOf, variable, digits, scientific, time, percent, tabs, tick, span, onSchemeChange } = report;
  const metrics = [
    { key: "relmse", name: "relMSE", floor: results.reference.noise_floor_relmse },
    { key: "flip_ldr", name: "FLIP", floor: 0 },
  ];
  let metric = metrics[0];
  let chart = null;

  const datasetOf = (curve) => ({
    label: curve.name,
    data: curve.points.filter((point) => point[metric.key] > 0 && point.seconds > 0)
      .map((point) => ({ x: point.seconds, y: point[metric.key], point })),
    showLine: true,
    borderColor: colorOf(curve),
    backgroundColor: curve.peer ? variable("--paper") : colorOf(curve),
    pointStyle: shapeOf(curve),
    borderDash: curve.peer ? [3, 4] : [],
    borderWidth: 2,
    pointBorderWidth: 2,
    pointRadius: 6,
    pointHoverRadius: 8,
  });
  const rings = {
    id: "rings",
    afterDatasetsDraw(drawn) {
      drawn.data.datasets.forEach((dataset, index) => {
        if (!drawn.isDatasetVisible(index)) return;
        drawn.getDatasetMeta(index).data.forEach((mark, at) => {
          if (!(dataset.data[at].point && dataset.data[at].point.pareto) || metric !== metrics[0]) return;
          drawn.ctx.save();
          drawn.ctx.strokeStyle = dataset.borderColor;
          drawn.ctx.lineWidth = 1.5;
          drawn.ctx.beginPath();
          drawn.ctx.arc(mark.x, mark.y, 11, 0, 2 * Math.PI);
          drawn.ctx.stroke();
          drawn.ctx.restore();
        });
      });
    },
  };
  const axis = (text, min, max) => ({ type: "logarithmic", min, max,
    grid: { color: variable("--grid"), borderColor: variable("--line") },
    title: { display: true, text, color: variable("--soft"), font: { size: 13 } },
    ticks: { callback: tick, color: variable("--soft"), autoSkip: false, maxRotation: 0 } });

  const draw = () => {
    if (chart) chart.destroy();
    const datasets = results.curves.map(datasetOf).filter((dataset) => dataset.data.length > 0);
    const all = datasets.flatMap((dataset) => dataset.data);
    // Of a sweep's many curves what counts: the best that Bounce does at each time. A band behind them.
    const front = metric === metrics[0] ? all.filter((item) => item.point.own_front).sort((a, b) => a.x - b.x) : [];
    if (front.length > 1) {
      datasets.push({ label: "Bounce's own front", data: front.map(({ x, y }) => ({ x, y })), showLine: true,
        borderColor: variable("--band"), backgroundColor: variable("--band"), borderWidth: 12, borderCapStyle: "round",
        borderJoinStyle: "round", pointRadius: 0, pointHitRadius: 0, pointStyle: "line", order: 1 });
    }
    if (all.length === 0) return;
    const [minX, maxX] = span(all.map((item) => item.x));
    const [minY, maxY] = span(all.map((item) => item.y).concat(metric.floor > 0 ? [metric.floor] : []));
    if (metric.floor > 0) {
      datasets.push({ label: "Noise of the reference", data: [{ x: minX, y: metric.floor }, { x: maxX, y: metric.floor }],
        showLine: true, borderDash: [8, 5], borderColor: "#8d97a3", backgroundColor: "#8d97a3", borderWidth: 1.5,
        pointRadius: 0, pointHitRadius: 0, pointStyle: "line" });
    }
    Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
    chart = new Chart(byId("chart"), {
      type: "scatter",
      data: { datasets },
      plugins: [rings],
      options: {
        animation: false,
        maintainAspectRatio: false,
        interaction: { mode: "nearest", intersect: true },
        scales: { x: axis("seconds a frame", minX, maxX), y: axis(metric.name, minY, maxY) },
        plugins: {
          legend: { position: "bottom",
            labels: { usePointStyle: true, boxWidth: 7, padding: 20, color: variable("--ink"), font: { size: 13 } } },
          tooltip: {
            padding: 10,
            filter: (item) => Boolean(item.raw.point),
            callbacks: {
              title: (items) => items.map((item) => `${item.dataset.label}, ${item.raw.point.label}`),
              label: (item) => {
                const point = item.raw.point;
                return [`${time(point.seconds)} a frame`, `relMSE ${scientific(point.relmse)}`,
                  `FLIP ${digits(point.flip_ldr, 3)}`, `bias ${percent(point.bias)}`]
                  .concat(point.measured ? ["measured by an earlier run"] : []);
              },
            },
          },
        },
      },
    });
  };
  tabs(byId("metric-tabs"), metrics.map((item) => item.name), 0, (index) => { metric = metrics[index]; draw(); });
  onSchemeChange(draw);
})();
