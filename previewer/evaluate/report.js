// SPDX-License-Identifier: Apache-2.0
// Fills the page of `bounce evaluate` from the two JSON elements in it: head, tables and facts. What the other scripts of
// the page share is in `report`.
"use strict";
const report = (() => {
  const results = JSON.parse(document.getElementById("results").textContent);
  const pictures = JSON.parse(document.getElementById("pictures").textContent);
  const byId = (id) => document.getElementById(id);

  // Told apart by people who see red and green alike (Okabe and Ito, 2008); Cycles in grey, brighter where it is dark.
  const dark = window.matchMedia("(prefers-color-scheme: dark)");
  const own = { light: ["#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#6a51a3"],
    dark: ["#ff8a3d", "#56b4e9", "#2cc79a", "#e29cc4", "#f0b840", "#a899e6"] };
  const others = { light: ["#7a5c3e", "#3f7f8c", "#8a4f6d"], dark: ["#c9a57f", "#7fc3d0", "#cf93b3"] };
  const grey = { light: "#4a5563", dark: "#b4bfcc" };
  const shapes = ["triangle", "circle", "rect", "rectRot", "star", "rectRounded"];
  const scheme = () => (dark.matches ? "dark" : "light");
  // Of each kind of curve its place among those of its kind; Bounce's last is its most complete one and comes first.
  const place = new Map();
  const ownCurves = results.curves.filter((curve) => !curve.reference_engine && !curve.peer).reverse();
  ownCurves.forEach((curve, index) => place.set(curve.name, index));
  results.curves.filter((curve) => curve.peer).forEach((curve, index) => place.set(curve.name, index));
  const colorOf = (curve) => {
    if (curve.reference_engine) return grey[scheme()];
    const palette = (curve.peer ? others : own)[scheme()];
    return palette[place.get(curve.name) % palette.length];
  };
  const shapeOf = (curve) =>
    curve.reference_engine ? "crossRot" : shapes[place.get(curve.name) % shapes.length];
  const variable = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

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
  // "−3 … +12 %": from the fastest to the slowest of the repeated renders, as parts of the median.
  const spread = (item) => {
    if (item.seconds_least === null || item.seconds_most === null || !(item.seconds > 0)) return "–";
    const part = (seconds) => { const value = Math.round(100 * (seconds / item.seconds - 1)); return value < 0 ? `−${-value}` : `+${value}`; };
    return `${part(item.seconds_least)} … ${part(item.seconds_most)} %`;
  };
  const bytes = (value) => (value > 0 ? `${digits(value / 2 ** 20, 3)} MiB` : "–");
  const element = (name, text, parent) => {
    const made = document.createElement(name);
    made.textContent = text;
    if (parent) parent.append(made);
    return made;
  };
  // Buttons of which one is pressed; act is called with its number, at first with that of `pressed`.
  const tabs = (parent, texts, pressed, act) => {
    const press = (index) => {
      [...parent.children].forEach((button, at) => button.setAttribute("aria-pressed", at === index));
      act(index);
    };
    texts.forEach((text, index) => {
      const button = element("button", text, parent);
      button.type = "button";
      button.addEventListener("click", () => press(index));
    });
    press(pressed);
  };
  // Of logarithmic axes: labels at 1, 2 and 5, and limits a little beyond the values.
  const tick = (value) => {
    const mantissa = value / 10 ** Math.floor(Math.log10(value) + 1e-9);
    return [1, 2, 5].some((known) => Math.abs(mantissa - known) < 1e-6) ? digits(value, 1) : "";
  };
  const span = (values) => [Math.min(...values) / 1.6, Math.max(...values) * 1.6];
  const onSchemeChange = (act) => dark.addEventListener("change", act);

  // ---- head ----
  document.title = `${results.scene}: error against run time`;
  byId("title").textContent = `${results.scene}: error against run time`;
  byId("subtitle").textContent =
    `${results.width} × ${results.height}, ${results.frames.length > 1 ? "frames" : "frame"} ` +
    `${results.frames.join(", ")} · ${results.gl.renderer || results.machine.cpu} · ${results.date.slice(0, 10)}`;

  const card = (value, text) => {
    const box = document.createElement("div");
    box.className = "card";
    element("b", value, box);
    element("span", text, box);
    byId("cards").append(box);
  };
  const points = ownCurves.flatMap((curve) => curve.points.map((point) => ({ ...point, curve: curve.name })))
    .filter((point) => point.relmse !== null && point.seconds !== null);
  // What one would use: of the points within a tenth of the smallest error, the fastest.
  const smallest = Math.min(...points.map((point) => point.relmse));
  const best = points.filter((point) => point.relmse <= 1.1 * smallest)
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
  // A reference from files may not say how it was made.
  const given = results.reference.engine !== "Cycles (CPU)";
  const spp = results.reference.spp > 0 ? `, ${results.reference.spp} spp` : "";
  const referenceText = given ? `${results.reference.engine}${spp}`
    : `Cycles ${results.reference.version}${spp}, ${time(results.reference.seconds)} a frame`;
  // How far the smallest error of a frame is above the noise of its reference: of the worst frame.
  const headrooms = results.reference.frames.filter((frame) => frame.noise_floor_relmse > 0 && frame.smallest_relmse !== null)
    .map((frame) => frame.smallest_relmse / frame.noise_floor_relmse);
  const headroom = headrooms.length ? Math.min(...headrooms) : null;
  card(results.reference.noise_floor_relmse === null ? "not known" : scientific(results.reference.noise_floor_relmse),
    `relMSE of the reference's own noise: ${referenceText}` +
    (headroom === null ? "" : `; ${headroom < 10 ? "only " : ""}${digits(headroom, 2)} times below the smallest error measured` +
      (headroom < 10 ? ", and a longer reference would be needed to tell small ones apart" : "")));

  // ---- table of all points ----
  const flipOf = (point) => {
    const cell = document.createDocumentFragment();
    cell.append(digits(point.flip_ldr, 3));
    if (point.flip_hdr !== null) element("small", `HDR ${digits(point.flip_hdr, 3)}`, cell);
    return cell;
  };
  const timeOf = (point) => {
    const cell = document.createDocumentFragment();
    cell.append(`${time(point.seconds)}${point.measured ? " †" : ""}`);
    if (point.seconds_least !== null) element("small", spread(point), cell);
    return cell;
  };
  // A curve's name behind a swatch of its colour, as a row's next cell.
  const curveCell = (row, curve, mark = "") => {
    const cell = row.insertCell();
    const swatch = element("span", "", cell);
    swatch.className = "swatch";
    swatch.style.background = colorOf(curve);
    cell.append(curve.name + mark);
  };
  const fillPoints = () => {
    const table = byId("points");
    table.replaceChildren();
    const head = table.createTHead().insertRow();
    for (const text of ["curve", "point", "time a frame", "relMSE", "FLIP", "bias", "Cycles at equal error", "ratio",
      "process", "OpenGL"]) {
      element("th", text, head);
    }
    const body = table.createTBody();
    for (const curve of results.curves) {
      for (const point of curve.points) {
        const row = body.insertRow();
        if (point.pareto) row.className = "front";
        curveCell(row, curve, point.own_front ? " ◆" : "");
        const speedup = speedupOf(curve.name, point.label);
        const equal = !speedup ? "" : speedup.cycles_time === "fastest_point" ? `≤ ${time(speedup.cycles_seconds)}`
          : `${time(speedup.cycles_seconds)}${speedup.cycles_time === "extrapolated" ? " *" : ""}`;
        for (const text of [point.label, timeOf(point), scientific(point.relmse),
          flipOf(point), percent(point.bias), equal, speedup ? ratioText(speedup) : "",
          bytes(point.rss_peak_bytes), bytes(point.gl_peak_bytes)]) {
          row.insertCell().append(text);
        }
      }
    }
  };
  fillPoints();
  onSchemeChange(fillPoints);
  const all = results.curves.flatMap((curve) => curve.points);
  const remarks = ["Process: the largest resident memory. Of Cycles and Eevee it is Blender's, up to that point. " +
    "OpenGL: the most bytes in buffers and textures at once, as Bounce counts its own."];
  if (all.some((point) => point.flip_hdr !== null)) {
    remarks.push("HDR: HDR-FLIP, the largest FLIP of each pixel over all exposures at which the reference shows something" +
      `${all.some((point) => point.flip_hdr === null && point.relmse !== null) ? "; of the points whose pictures are shown above" : ""}.`);
  }
  if (results.speedup_at_equal_error.some((item) => item.cycles_time === "extrapolated")) {
    remarks.push("* Beyond Cycles' last point, along its last segment, but not flatter than noise falls.");
  }
  const exact = all.filter((point) => point.relmse === 0).length;
  if (exact) {
    remarks.push(`${exact === 1 ? "One point has" : `${exact} points have`} error 0, which has no place on a logarithmic axis, ` +
      "and so on the chart.");
  }
  const dates = [...new Set(all.filter((point) => point.measured).map((point) => point.measured.slice(0, 10)))];
  if (dates.length) remarks.push(`† Measured on this machine by an earlier run (${dates.join(", ")}), not in this one.`);
  const remark = element("p", remarks.join(" "), byId("points").parentElement.parentElement);
  remark.className = "soft";
  remark.style.fontSize = "13px";

  // ---- before the first frame ----
  const startup = byId("startup");
  const startupHead = startup.createTHead().insertRow();
  for (const text of ["engine", "export", "display", "start", "load", "first render", "what the figures hold"]) {
    element("th", text, startupHead);
  }
  const startupBody = startup.createTBody();
  for (const item of results.startup) {
    const row = startupBody.insertRow();
    for (const text of [item.engine, ...[item.export_seconds, item.display_seconds, item.start_seconds,
      item.load_seconds, item.first_render_seconds]
      .map((seconds) => (seconds === null ? "–" : time(seconds))), item.note]) {
      row.insertCell().textContent = text;
    }
  }

  // ---- facts ----
  const fact = (name, text) => {
    element("dt", name, byId("facts"));
    element("dd", text, byId("facts"));
  };
  const cycles = results.curves.find((curve) => curve.reference_engine);
  const setup = cycles && cycles.points.length > 0 ? cycles.points[0].setup_seconds : 0;
  fact("Reference", given ? `${referenceText}; its direct light and ${results.reference.bounces} bounces as it says itself.`
    : `Cycles on the CPU, ${results.blender}, ${results.reference.threads} threads, ` +
    `${results.reference.spp} samples a pixel in two halves with different seeds: direct light and ` +
    `${results.reference.bounces} bounce${results.reference.bounces === 1 ? "" : "s"}, diffuse or glossy; no ` +
    "clamping, denoiser or adaptive sampling; Blackman-Harris filter, width 1.5.");
  fact("Error", "relMSE: mean over pixels and channels of (a − b)² / (b² + 0.01) on scene-linear values. FLIP " +
    "(Andersson et al., 2020) after the Standard view transform. Bias: mean(a) / mean(b) − 1.");
  if (results.reference.noise_floor_relmse !== null) fact("Noise floor", `An exact picture would score ${scientific(results.reference.noise_floor_relmse)} against this ` +
    "reference: half the difference of two halves with different seeds, squared and weighted as in relMSE" +
    (headroom === null ? "." : `. The smallest error measured here is ${digits(headroom, 2)} times as large.`));
  fact("Time", "Per frame in steady state: Cycles renders a frame once before the render that is timed (the median of " +
    "three up to 16 spp); Bounce's is the median of repeated renders after a warm-up. Files are written outside it." +
    (setup > 0 ? ` Cycles' set-up of each frame (transfer and BVH), which is in its times: ${time(setup)}.` : ""));
  for (const peer of results.peers) {
    if (results.curves.some((curve) => curve.name === peer.name)) fact(peer.name, peer.settings);
    for (const text of peer.left_out) fact("Left out", text);
    for (const text of peer.notes) fact(`Note, ${peer.name}`, text);
  }
  fact("Machine", `${results.machine.cpu}, ${results.machine.threads} threads, ${results.machine.system}`);
  fact("OpenGL", [results.gl.renderer, results.gl.version, results.gl.vendor].filter(Boolean).join(" · ") || "unknown");
  for (const note of results.notes) fact("Note", note);
  byId("command").textContent = results.command;
  byId("copy").addEventListener("click", async () => {
    // A page from a file has no clipboard in every browser: then the text is selected instead.
    try {
      await navigator.clipboard.writeText(results.command);
      byId("copy").textContent = "Copied";
    } catch {
      getSelection().selectAllChildren(byId("command"));
    }
  });

  return { results, pictures, byId, best, colorOf, curveCell, shapeOf, variable, scheme, digits, scientific, time, percent, element, spread, tick, span,
    tabs, onSchemeChange };
})();
