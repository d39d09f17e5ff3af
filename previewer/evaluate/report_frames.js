// SPDX-License-Identifier: Apache-2.0
// Errors and times of each frame, where there is more than one.
"use strict";
(() => {
  const { results, byId, best, colorOf, variable, digits, scientific, time, percent, element, spread, tick, span,
    onSchemeChange } = report;
  if (results.frames.length < 2) {
    byId("frame-by-frame").hidden = true;
    return;
  }
  const all = results.curves.flatMap((curve) => curve.points.map((point) => ({ curve, point })));
  const select = byId("frames-point");
  all.forEach(({ curve, point }, index) => { element("option", `${curve.name}, ${point.label}`, select).value = index; });
  select.value = Math.max(0, all.findIndex(({ curve, point }) => best && curve.name === best.curve && point.label === best.label));

  let chart = null;
  const draw = () => {
    if (chart) chart.destroy();
    const { curve, point } = all[select.value];
    const line = (label, data, color, dash) => ({ label, data, borderColor: color, backgroundColor: color, borderWidth: 2,
      borderDash: dash, pointRadius: results.frames.length > 60 ? 0 : 4, pointHitRadius: 8, tension: 0 });
    const ticks = { color: variable("--soft") };
    const grid = { color: variable("--grid"), borderColor: variable("--line") };
    const noise = results.reference.frames.map((frame) => frame.noise_floor_relmse);
    const [min, max] = span(point.frames.map((frame) => frame.relmse).concat(noise).filter((value) => value > 0));
    const title = (text) => ({ display: true, text, color: variable("--soft"), font: { size: 13 } });
    chart = new Chart(byId("frames-chart"), {
      type: "line",
      data: { labels: point.frames.map((frame) => frame.frame),
        datasets: [line("relMSE", point.frames.map((frame) => frame.relmse), colorOf(curve), []),
          line("noise of the reference", noise, "#8d97a3", [8, 5])] },
      options: { animation: false, maintainAspectRatio: false, interaction: { mode: "index", intersect: false },
        scales: { x: { title: title("frame"), ticks, grid }, y: { type: "logarithmic", min, max, title: title("relMSE"), grid,
          ticks: { ...ticks, callback: tick, autoSkip: false } } },
        plugins: { legend: { position: "bottom", labels: { color: variable("--ink"), boxWidth: 14, boxHeight: 2 } },
          tooltip: { callbacks: { title: (items) => `frame ${items[0].label}`,
            label: (item) => `${item.dataset.label}: ${scientific(item.raw)}` } } } },
    });
    const table = byId("frames-table");
    table.replaceChildren();
    const hdr = point.flip_hdr !== null;
    const head = table.createTHead().insertRow();
    for (const text of ["frame", "time", "fastest to slowest", "relMSE", "FLIP", ...(hdr ? ["HDR-FLIP"] : []), "SSIM", "PSNR", "bias"]) element("th", text, head);
    const body = table.createTBody();
    for (const frame of point.frames) {
      const row = body.insertRow();
      for (const text of [frame.frame, time(frame.seconds), spread(frame), scientific(frame.relmse), digits(frame.flip_ldr, 3),
        ...(hdr ? [digits(frame.flip_hdr, 3)] : []), digits(frame.ssim, 4), frame.psnr_db === null ? "–" : `${digits(frame.psnr_db, 3)} dB`, percent(frame.bias)]) {
        row.insertCell().textContent = text;
      }
    }
  };
  select.addEventListener("change", draw);
  draw();
  onSchemeChange(draw);
})();
