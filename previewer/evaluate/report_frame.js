// SPDX-License-Identifier: Apache-2.0
// Where a frame's time goes, pass by pass, and what it leaves out.
"use strict";
(() => {
  const { results, byId, best, variable, scheme, time, element, tabs, onSchemeChange } = report;
  const runs = results.passes;
  if (runs.length === 0) {
    byId("passes-section").hidden = true;
    byId("plan-section").hidden = true;
    return;
  }
  // Passes of one kind are one colour, whichever light they are of: "shadow map: Spot".
  const kindOf = (name) => name.split(":")[0];
  const palettes = {
    light: ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#d55e00", "#56b4e9", "#8c6bb1", "#b5b35c", "#b0b8c1"],
    dark: ["#4a9fd8", "#f0b840", "#2cc79a", "#e29cc4", "#ff8a3d", "#8fd0f5", "#a899e6", "#d3d17a", "#6c7886"] };
  const rest = "everything else";
  const totals = new Map();
  for (const run of runs) {
    for (const pass of run.passes) totals.set(kindOf(pass.name), (totals.get(kindOf(pass.name)) || 0) + pass.seconds);
  }
  const kinds = [...totals.keys()].sort((a, b) => totals.get(b) - totals.get(a));
  const named = kinds.slice(0, palettes.light.length - 1);
  const groups = kinds.length > named.length ? [...named, rest] : named;
  const groupOf = (name) => (named.includes(kindOf(name)) ? kindOf(name) : rest);
  const colorOf = (group) => palettes[scheme()][group === rest ? palettes.light.length - 1 : named.indexOf(group)];
  const sum = (run, group, key) =>
    run.passes.filter((pass) => groupOf(pass.name) === group).reduce((total, pass) => total + pass[key], 0);
  const spread = (least, most) => `${time(least)} to ${time(most)}`;
  const nameOf = (run) => (run.curve === run.label ? run.curve : `${run.curve}, ${run.label}`);

  byId("passes-note").textContent = `Frame ${runs[0].frame}, rendered again with each pass timed on its own: waiting ` +
    "for each makes the sum longer than the frame. Medians; hover over a bar for its figures and their spread.";
  byId("passes-box").style.height = `${90 + 30 * runs.length}px`;
  // Beside a point that takes a hundred times as long the others' bars are too short to read: shares show them.
  const total = (run) => run.passes.reduce((sum, pass) => sum + pass.seconds, 0);
  let shares = false;
  const length = (run, group) => (shares ? 100 / total(run) : 1000) * sum(run, group, "seconds");
  let chart = null;
  const draw = () => {
    if (chart) chart.destroy();
    chart = new Chart(byId("passes"), {
      type: "bar",
      data: { labels: runs.map(nameOf),
        datasets: groups.map((group) => ({ label: group, data: runs.map((run) => length(run, group)),
          backgroundColor: colorOf(group), borderColor: variable("--paper"), borderWidth: { right: 1 }, barPercentage: 0.72,
          categoryPercentage: 1 })) },
      options: {
        indexAxis: "y",
        animation: false,
        maintainAspectRatio: false,
        interaction: { mode: "nearest", intersect: true },
        scales: {
          x: { stacked: true, max: shares ? 100 : undefined, grid: { color: variable("--grid"), borderColor: variable("--line") },
            title: { display: true, text: shares ? "per cent of the passes' time" : "milliseconds", color: variable("--soft"), font: { size: 13 } },
            ticks: { color: variable("--soft") } },
          y: { stacked: true, grid: { display: false, borderColor: variable("--line") },
            ticks: { color: variable("--ink"), font: { size: 13 }, autoSkip: false } },
        },
        plugins: {
          legend: { position: "bottom", labels: { boxWidth: 11, boxHeight: 11, padding: 14, color: variable("--ink") } },
          tooltip: { padding: 10, callbacks: {
            label: (item) => {
              const run = runs[item.dataIndex];
              const group = item.dataset.label;
              return `${group}: ${time(sum(run, group, "seconds"))} (${spread(sum(run, group, "seconds_least"),
                sum(run, group, "seconds_most"))})`;
            },
            footer: (items) => {
              const run = runs[items[0].dataIndex];
              return `all passes: ${time(total(run))}`;
            } } },
        },
      },
    });
  };

  const select = byId("plan-point");
  const start = Math.max(0, runs.findIndex((run) => best && run.curve === best.curve && run.label === best.label));
  runs.forEach((run, index) => { element("option", nameOf(run), select).value = index; });
  select.value = start;
  const showPlan = () => {
    const run = runs[select.value];
    const longest = Math.max(...run.passes.map((pass) => pass.seconds));
    const table = byId("plan-ran");
    table.replaceChildren();
    for (const pass of run.passes) {
      const row = table.insertRow();
      row.insertCell().textContent = pass.name;
      const cell = row.insertCell();
      cell.className = "bar";
      const bar = element("i", "", cell);
      bar.style.width = `${100 * pass.seconds / longest}%`;
      bar.style.background = colorOf(groupOf(pass.name));
      const figure = row.insertCell();
      figure.textContent = time(pass.seconds);
      figure.title = spread(pass.seconds_least, pass.seconds_most);
    }
    const reasons = byId("plan-left-out");
    reasons.replaceChildren();
    for (const item of run.left_out) {
      element("dt", item.pass, reasons);
      element("dd", item.reason, reasons);
    }
    if (run.left_out.length === 0) element("dd", "nothing", reasons);
    byId("plan-approximated").replaceChildren();
    byId("plan-approximated-title").hidden = run.approximations.length === 0;
    for (const text of run.approximations) element("li", text, byId("plan-approximated"));
  };
  select.addEventListener("change", showPlan);
  const update = () => { draw(); showPlan(); };
  tabs(byId("passes-tabs"), ["Time", "Share"], 0, (index) => { shares = index === 1; draw(); });
  showPlan();
  onSchemeChange(update);
})();
