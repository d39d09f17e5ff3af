// SPDX-License-Identifier: Apache-2.0
// Fills the page of `bounce evaluate` from the two JSON elements in it.
"use strict";
(() => {
  const results = JSON.parse(document.getElementById("results").textContent);
  const pictures = JSON.parse(document.getElementById("pictures").textContent);
  const byId = (id) => document.getElementById(id);

  // Told apart by people who see red and green alike (Okabe and Ito, 2008), Cycles in grey.
  const palette = ["#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00"];
  const shapes = ["triangle", "circle", "rect", "rectRot", "star"];
  const colors = new Map();
  const markers = new Map();
  let next = 0;
  for (const curve of results.curves) {
    colors.set(curve.name, curve.reference_engine ? "#4a5563" : palette[next % palette.length]);
    markers.set(curve.name, curve.reference_engine ? "crossRot" : shapes[next % shapes.length]);
    if (!curve.reference_engine) next += 1;
  }

  const digits = (value, count) => (value === null ? "not a number" : Number(value.toPrecision(count)).toString());
  const scientific = (value) => {
    if (value === null) return "not a number";
    if (value === 0) return "0";
    return value >= 0.01 && value < 1000 ? digits(value, 3) : value.toExponential(2);
  };
  const time = (seconds) => {
    if (seconds === null) return "not a number";
    return seconds < 1 ? `${digits(seconds * 1000, 3)} ms` : `${digits(seconds, 3)} s`;
  };
  const percent = (value) =>
    value === null ? "not a number" : `${value >= 0 ? "+" : "−"}${Math.abs(value * 100).toFixed(2)} %`;
  const element = (name, text, parent) => {
    const made = document.createElement(name);
    made.textContent = text;
    if (parent) parent.append(made);
    return made;
  };

  // ---- head ----
  document.title = `${results.scene}: error against run time`;
  byId("title").textContent = `${results.scene}: error against run time`;
  byId("subtitle").textContent =
    `${results.width} × ${results.height}, ${results.frames.length > 1 ? "frames" : "frame"} ` +
    `${results.frames.join(", ")} · ${results.date.slice(0, 10)}`;

  const card = (value, text) => {
    const box = document.createElement("div");
    box.className = "card";
    element("b", value, box);
    element("span", text, box);
    byId("cards").append(box);
  };
  const own = results.curves.filter((curve) => !curve.reference_engine)
    .flatMap((curve) => curve.points.map((point) => ({ ...point, curve: curve.name })))
    .filter((point) => point.relmse !== null && point.seconds !== null);
  // What one would use: of the points within a tenth of the smallest error, the fastest.
  const smallest = Math.min(...own.map((point) => point.relmse));
  const best = own.filter((point) => point.relmse <= 1.1 * smallest)
    .reduce((a, b) => (!a || b.seconds < a.seconds ? b : a), null);
  const speedupOf = (curve, label) =>
    results.speedup_at_equal_error.find((item) => item.curve === curve && item.label === label);
  const ratioText = (item) => `${item.cycles_time === "fastest_point" ? "≤ " : ""}${digits(item.ratio, 3)}×`;
  if (best) {
    const speedup = speedupOf(best.curve, best.label);
    if (speedup) {
      const how = { interpolated: "", extrapolated: " (extrapolated)", fastest_point: " (its fastest)" };
      card(ratioText(speedup), `the speed of Cycles at equal error: ${time(speedup.bounce_seconds)} a frame against ` +
        `${time(speedup.cycles_seconds)}${how[speedup.cycles_time]}`);
    }
    card(time(best.seconds), `a frame: ${best.curve}, ${best.label}, the fastest within 10 % of the smallest error`);
    card(scientific(best.relmse), `its relMSE, with a bias of ${percent(best.bias)} and FLIP ${digits(best.flip_ldr, 3)}`);
  }
  card(scientific(results.reference.noise_floor_relmse),
    `relMSE of the reference's own noise: Cycles ${results.reference.version}, ${results.reference.spp} spp, ` +
    `${time(results.reference.seconds)} a frame`);

  // ---- chart ----
  const tick = (value) => {
    const mantissa = value / 10 ** Math.floor(Math.log10(value) + 1e-9);
    return [1, 2, 5].some((known) => Math.abs(mantissa - known) < 1e-6) ? digits(value, 1) : "";
  };
  const datasets = results.curves.map((curve) => ({
    label: curve.name,
    data: curve.points.filter((point) => point.relmse > 0 && point.seconds > 0)
      .map((point) => ({ x: point.seconds, y: point.relmse, point })),
    showLine: true,
    borderColor: colors.get(curve.name),
    backgroundColor: colors.get(curve.name),
    pointStyle: markers.get(curve.name),
    borderWidth: 2,
    pointRadius: 6,
    pointHoverRadius: 8,
  }));
  const all = datasets.flatMap((dataset) => dataset.data);
  const floor = results.reference.noise_floor_relmse;
  const span = (values) => [Math.min(...values) / 1.6, Math.max(...values) * 1.6];
  const [minX, maxX] = span(all.map((item) => item.x));
  const [minY, maxY] = span(all.map((item) => item.y).concat(floor > 0 ? [floor] : []));
  if (floor > 0) {
    datasets.push({ label: "Noise of the reference", data: [{ x: minX, y: floor }, { x: maxX, y: floor }],
      showLine: true, borderDash: [6, 5], borderColor: "#9aa3ad", backgroundColor: "#9aa3ad", borderWidth: 1.5,
      pointRadius: 0, pointHitRadius: 0, pointStyle: "line" });
  }
  const rings = {
    id: "rings",
    afterDatasetsDraw(chart) {
      chart.data.datasets.forEach((dataset, index) => {
        if (!chart.isDatasetVisible(index)) return;
        chart.getDatasetMeta(index).data.forEach((mark, at) => {
          if (!(dataset.data[at].point && dataset.data[at].point.pareto)) return;
          chart.ctx.save();
          chart.ctx.strokeStyle = dataset.borderColor;
          chart.ctx.lineWidth = 1.5;
          chart.ctx.beginPath();
          chart.ctx.arc(mark.x, mark.y, 11, 0, 2 * Math.PI);
          chart.ctx.stroke();
          chart.ctx.restore();
        });
      });
    },
  };
  const axis = (text, min, max) => ({ type: "logarithmic", min, max, grid: { color: "#eceff2" },
    title: { display: true, text, color: "#5c6773", font: { size: 13 } },
    ticks: { callback: tick, color: "#5c6773", autoSkip: false, maxRotation: 0 } });
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
  new Chart(byId("chart"), {
    type: "scatter",
    data: { datasets },
    plugins: [rings],
    options: {
      animation: false,
      maintainAspectRatio: false,
      interaction: { mode: "nearest", intersect: true },
      scales: { x: axis("seconds a frame", minX, maxX), y: axis("relMSE", minY, maxY) },
      plugins: {
        legend: { position: "bottom", labels: { usePointStyle: true, padding: 18, color: "#1c2430" } },
        tooltip: {
          filter: (item) => Boolean(item.raw.point),
          callbacks: {
            title: (items) => items.map((item) => `${item.dataset.label}, ${item.raw.point.label}`),
            label: (item) => {
              const point = item.raw.point;
              return [`${time(point.seconds)} a frame`, `relMSE ${scientific(point.relmse)}`,
                `FLIP ${digits(point.flip_ldr, 3)}`, `bias ${percent(point.bias)}`];
            },
          },
        },
      },
    },
  });

  // ---- frames ----
  const view = results.view;
  byId("frames-note").textContent = `Shown through ${view.transform}` +
    `${view.look && view.look !== "None" ? ` (${view.look})` : ""}` +
    `${view.exposure ? `, ${view.exposure} stops` : ""}. Of each way of rendering the most exact point; of Cycles the ` +
    "one whose time is nearest. Click a picture for its pixels.";
  const shown = { frame: 0, preview: 0 };
  const buttons = (parent, texts, key) => texts.forEach((text, index) => {
    const button = element("button", text, parent);
    button.type = "button";
    button.addEventListener("click", () => { shown[key] = index; show(); });
  });
  const show = () => {
    const frame = pictures[shown.frame];
    const preview = frame.previews[shown.preview];
    const point = results.curves.find((curve) => curve.name === preview.curve)
      .points.find((item) => item.label === preview.label).frames.find((item) => item.frame === frame.frame);
    const reference = results.reference.frames[shown.frame];
    byId("preview").src = preview.image;
    byId("preview").alt = `${preview.curve}, ${preview.label}`;
    byId("preview-caption").textContent = `${preview.curve}, ${preview.label}: ${time(point.seconds)}, ` +
      `relMSE ${scientific(point.relmse)}, bias ${percent(point.bias)}`;
    byId("reference").src = frame.reference;
    byId("reference").alt = "Reference";
    byId("reference-caption").textContent =
      `Reference: Cycles, ${results.reference.spp} spp, ${time(reference.seconds)}`;
    byId("difference").src = preview.difference;
    byId("difference").alt = "Difference";
    for (const [id, key] of [["frame-tabs", "frame"], ["preview-tabs", "preview"]]) {
      [...byId(id).children].forEach((button, index) => button.setAttribute("aria-pressed", index === shown[key]));
    }
  };
  if (pictures.length > 0 && pictures[0].previews.length > 0) {
    buttons(byId("frame-tabs"), pictures.map((item) => `Frame ${item.frame}`), "frame");
    buttons(byId("preview-tabs"), pictures[0].previews.map((item) => item.curve), "preview");
    show();
  }
  const zoom = byId("zoom");
  for (const image of document.querySelectorAll("figure img")) {
    image.addEventListener("click", () => { zoom.firstElementChild.src = image.src; zoom.showModal(); });
  }
  zoom.addEventListener("click", () => zoom.close());

  // ---- table ----
  const table = byId("points");
  const head = table.createTHead().insertRow();
  for (const text of ["curve", "point", "time a frame", "relMSE", "FLIP", "bias", "Cycles at equal error", "ratio"]) {
    element("th", text, head);
  }
  const body = table.createTBody();
  for (const curve of results.curves) {
    for (const point of curve.points) {
      const row = body.insertRow();
      if (point.pareto) row.className = "front";
      const name = row.insertCell();
      const swatch = element("span", "", name);
      swatch.className = "swatch";
      swatch.style.background = colors.get(curve.name);
      name.append(curve.name);
      const speedup = speedupOf(curve.name, point.label);
      const equal = !speedup ? "" : speedup.cycles_time === "fastest_point" ? `≤ ${time(speedup.cycles_seconds)}`
        : `${time(speedup.cycles_seconds)}${speedup.cycles_time === "extrapolated" ? " (extrapolated)" : ""}`;
      for (const text of [point.label, time(point.seconds), scientific(point.relmse), digits(point.flip_ldr, 3),
        percent(point.bias), equal, speedup ? ratioText(speedup) : ""]) {
        row.insertCell().textContent = text;
      }
    }
  }

  // ---- facts ----
  const fact = (name, text, code) => {
    element("dt", name, byId("facts"));
    const value = element("dd", code ? "" : text, byId("facts"));
    if (code) element("code", text, value);
  };
  const cycles = results.curves.find((curve) => curve.reference_engine);
  const startups = own.map((point) => point.startup_seconds);
  fact("Reference", `Cycles on the CPU, ${results.blender}, ${results.reference.threads} threads, ` +
    `${results.reference.spp} samples a pixel in two halves with different seeds: direct light and ` +
    `${results.reference.bounces} bounce${results.reference.bounces === 1 ? "" : "s"}, diffuse or glossy; no ` +
    "clamping, denoiser or adaptive sampling; Blackman-Harris filter, width 1.5.");
  fact("Error", "relMSE: mean over pixels and channels of (a − b)² / (b² + 0.01) on scene-linear values. FLIP " +
    "(Andersson et al., 2020) after the Standard view transform. Bias: mean(a) / mean(b) − 1.");
  fact("Noise floor", `An exact picture would score ${scientific(floor)} against this reference: half the difference ` +
    "of its two halves, squared and weighted as in relMSE.");
  fact("Time", "Per frame in steady state: Cycles renders a frame once before the render that is timed (the median of " +
    "three up to 4 spp); Bounce's is the median of repeated renders after a warm-up. Files are written outside it.");
  if (cycles && cycles.points.length > 0) {
    fact("Start-up", `Not in the times above. Cycles: ${time(cycles.points[0].startup_seconds)} to open the scene, ` +
      `${time(results.reference.first_render_seconds)} for the first render of one sample; its set-up in each frame ` +
      `(transfer and BVH), which is in its times, ${time(cycles.points[0].setup_seconds)}. ` +
      (startups.length ? `Bounce: ${time(Math.min(...startups))} to ${time(Math.max(...startups))} a run.` : ""));
  }
  fact("Machine", `${results.machine.cpu}, ${results.machine.threads} threads, ${results.machine.system}`);
  fact("OpenGL", [results.gl.renderer, results.gl.version, results.gl.vendor].filter(Boolean).join(" · ") || "unknown");
  for (const note of results.notes) fact("Note", note);
  fact("Command", results.command, true);
})();
