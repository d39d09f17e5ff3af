// SPDX-License-Identifier: Apache-2.0
// Fills the page of `bounce bench` from the JSON element in it.
"use strict";
(() => {
  const results = JSON.parse(document.getElementById("results").textContent);
  const byId = (id) => document.getElementById(id);
  const element = (name, text, parent) => {
    const made = document.createElement(name);
    made.textContent = text;
    if (parent) parent.append(made);
    return made;
  };

  // Significant digits without exponents, as the tables of the terminal.
  const number = (value, digits = 3) => {
    if (value === null) return "not a number";
    if (value === 0) return "0";
    const before = Math.floor(Math.log10(Math.abs(value))) + 1;
    return value.toFixed(Math.max(0, digits - before));
  };

  // Told apart by people who see red and green alike (Okabe and Ito, 2008).
  const palette = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6b5b95", "#a0522d"];
  const shapes = ["circle", "triangle", "rect", "rectRot", "star", "crossRot", "cross", "rectRounded"];
  const soft = "#5c6773";
  Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;

  // ---- head ----
  document.title = `${results.title}: ${results.scene}`;
  byId("title").textContent = results.title;
  byId("subtitle").textContent = `${results.scene} · ${results.date.slice(0, 10)}`;
  for (const check of results.checks) {
    const box = document.createElement("div");
    box.className = `card ${check.met ? "met" : "missed"}`;
    const shown = (value) => (Number.isInteger(value) ? String(value) : number(value));
    element("b", `${shown(check.value)} ${check.unit}`.trim(), box);
    element("span", check.what, box);
    const limit = `${check.kind === "at_least" ? "at least" : "at most"} ${shown(check.limit)}`;
    element("em", check.met ? `met: ${limit}` : `not met: ${limit}`, box);
    byId("cards").append(box);
  }

  // ---- plots ----
  const tick = (value) => {
    if (value <= 0) return "";
    const mantissa = value / 10 ** Math.floor(Math.log10(value) + 1e-9);
    return [1, 2, 5].some((known) => Math.abs(mantissa - known) < 1e-6) ? number(value, 1) : "";
  };
  // A logarithmic axis over counts shows the counts that were measured.
  const doubling = (plot) => {
    const xs = [...new Set(plot.series.flatMap((series) => series.points.map((point) => point.x)))].sort((a, b) => a - b);
    return plot.x.log && xs.length <= 10 ? xs : null;
  };
  const axis = (spec) => ({
    type: spec.log ? "logarithmic" : "linear",
    grid: { color: "#eceff2" },
    title: { display: true, text: spec.label, color: soft, font: { size: 13 } },
    ticks: spec.log ? { callback: tick, color: soft, autoSkip: false, maxRotation: 0 } : { color: soft, maxRotation: 0 },
    beginAtZero: !spec.log,
  });
  const legend = { position: "bottom", labels: { usePointStyle: true, padding: 16, color: "#1c2430" } };

  const lines = (canvas, plot) => {
    let next = 0;
    const datasets = plot.series.map((series) => {
      const color = series.from_paper ? "#9aa3ad" : palette[next % palette.length];
      const shape = series.from_paper ? "line" : shapes[next % shapes.length];
      if (!series.from_paper) next += 1;
      return {
        label: series.name, data: series.points.filter((point) => point.y !== null), showLine: true, borderColor: color, backgroundColor: color,
        pointStyle: shape, borderDash: series.from_paper ? [6, 5] : [], borderWidth: 2,
        pointRadius: series.from_paper ? 0 : 5, pointHoverRadius: 8,
      };
    });
    const x = axis(plot.x);
    const measured = doubling(plot);
    if (measured) {
      x.min = measured[0] / 1.15;
      x.max = measured[measured.length - 1] * 1.15;
      x.afterBuildTicks = (scale) => { scale.ticks = measured.map((value) => ({ value })); };
      x.ticks.callback = (value) => number(value, 3);
    }
    new Chart(canvas, {
      type: "scatter",
      data: { datasets },
      options: {
        animation: false, maintainAspectRatio: false,
        scales: { x, y: axis(plot.y) },
        plugins: {
          legend,
          tooltip: { callbacks: {
            title: (items) => items.map((item) => item.dataset.label),
            label: (item) => `${number(item.raw.x)} → ${number(item.raw.y)}`,
          } },
        },
      },
    });
  };

  const stacked = (canvas, plot) => {
    // Many bars have names that do not fit under them.
    const lying = plot.bars.length > 8;
    const [names, values] = lying ? ["y", "x"] : ["x", "y"];
    const datasets = plot.series.map((series, index) => ({
      label: series.name,
      data: plot.bars.map((_, bar) => (series.points.find((point) => point.x === bar) || { y: 0 }).y),
      backgroundColor: palette[index % palette.length],
      maxBarThickness: 72,
    }));
    new Chart(canvas, {
      type: "bar",
      data: { labels: plot.bars, datasets },
      options: {
        animation: false, maintainAspectRatio: false, indexAxis: names,
        scales: {
          [names]: { stacked: true, grid: { display: false }, ticks: { color: soft, autoSkip: false },
            title: { display: plot.x.label !== "", text: plot.x.label, color: soft, font: { size: 13 } } },
          [values]: { ...axis(plot.y), stacked: true },
        },
        plugins: { legend: { ...legend, labels: { ...legend.labels, usePointStyle: true, pointStyle: "rect" } },
          tooltip: { callbacks: { label: (item) => `${item.dataset.label}: ${number(item.raw)}` } } },
      },
    });
  };

  for (const plot of results.plots) {
    const section = document.createElement("section");
    element("h2", plot.title, section);
    if (plot.note) element("p", plot.note, section).className = "soft";
    const box = document.createElement("div");
    box.className = "chart";
    const canvas = document.createElement("canvas");
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", plot.title);
    box.append(canvas);
    section.append(box);
    byId("plots").append(section);
    (plot.kind === "stacked" ? stacked : lines)(canvas, plot);
  }

  // ---- tables ----
  for (const table of results.tables) {
    const section = document.createElement("section");
    element("h2", table.title, section);
    if (table.note) element("p", table.note, section).className = "soft";
    const scroll = document.createElement("div");
    scroll.className = "scroll";
    const made = document.createElement("table");
    const kind = (column) => (table.columns[column].kind === "text" ? "text" : "number");
    const shown = (cell, column) => {
      if (cell === null) return "–";
      if (typeof cell !== "number") return cell;
      return table.columns[column].kind === "count" ? String(cell) : number(cell);
    };
    const head = made.createTHead().insertRow();
    table.columns.forEach((column, index) => {
      element("th", column.unit ? `${column.name}, ${column.unit}` : column.name, head).className = kind(index);
    });
    const body = made.createTBody();
    for (const row of table.rows) {
      const line = body.insertRow();
      row.forEach((cell, index) => {
        const data = line.insertCell();
        const text = shown(cell, index);
        const parts = text.split(", ");
        const list = parts.length > 2;  // takes a line more between its parts, where there is no room
        data.className = kind(index) + (list ? " list" : "");
        data.textContent = list ? parts.map((part) => part.replaceAll(" ", "\u00a0")).join(", ") : text;
      });
    }
    scroll.append(made);
    section.append(scroll);
    byId("tables").append(section);
  }

  // ---- the paper, facts ----
  const list = byId("paper").querySelector("ul");
  for (const line of results.paper) element("li", line, list);
  if (results.paper.length === 0) byId("paper").remove();
  const fact = (name, text, code) => {
    element("dt", name, byId("facts"));
    const value = element("dd", code ? "" : text, byId("facts"));
    if (code) element("code", text, value);
  };
  fact("Settings", Object.entries(results.settings).map(([name, value]) => `${name} ${value}`).join(", "));
  fact("Times", results.timing);
  for (const note of results.notes) fact("Note", note);
  fact("Machine", `${results.machine.cpu}, ${results.machine.threads} threads, ${results.machine.system}`);
  fact("OpenGL", [results.gl.renderer, results.gl.version, results.gl.vendor].filter(Boolean).join(" · "));
  fact("Command", results.command, true);
})();
