// SPDX-License-Identifier: Apache-2.0
// Which settings win within a time a frame.
"use strict";
(() => {
  const { results, byId, digits, scientific, time, percent, element } = report;
  const table = byId("budgets");
  const head = table.createTHead().insertRow();
  for (const text of ["budget", "point", "time a frame", "relMSE", "FLIP", "bias", "options of bounce render"]) {
    element("th", text, head);
  }
  const body = table.createTBody();
  for (const budget of results.budgets) {
    const row = body.insertRow();
    row.insertCell().textContent = time(budget.budget_ms / 1000);
    if (!budget.options) {
      const cell = row.insertCell();
      cell.colSpan = 6;
      cell.className = "soft";
      cell.textContent = "no point is as fast";
      continue;
    }
    for (const text of [`${budget.curve}, ${budget.label}`, time(budget.seconds), scientific(budget.relmse),
      digits(budget.flip_ldr, 3), percent(budget.bias)]) {
      row.insertCell().textContent = text;
    }
    element("code", budget.options.join(" ") || "none", row.insertCell());
  }
})();
