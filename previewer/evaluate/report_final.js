// SPDX-License-Identifier: Apache-2.0
// What is left to the picture that the artist will get: Cycles by the scene's own light paths.
"use strict";
(() => {
  const { results, byId, curveCell, digits, scientific, percent, element, onSchemeChange } = report;
  const final = results.final_render;
  if (!final) {
    byId("final-section").hidden = true;
    return;
  }
  const floor = Math.max(...final.frames.map((frame) => frame.noise_floor_relmse));
  byId("final-note").textContent = "The errors everywhere else on this page are against a reference whose light paths are those that " +
    `Bounce computes (${results.reference.bounces} ${results.reference.bounces === 1 ? "bounce" : "bounces"}, nothing clamped). Here the ` +
    "same pictures stand against Cycles with the light paths that the scene itself asks for. The first row is that reference: what " +
    `a preview without any error of its own would be off by. Noise floor ${scientific(floor)}.`;
  const rows = results.curves.flatMap((curve) => curve.points.filter((point) => point.final_render)
    .map((point) => ({ curve, label: point.label, errors: point.final_render })));
  const fill = () => {
    const table = byId("final");
    table.replaceChildren();
    const head = table.createTHead().insertRow();
    for (const text of ["curve", "point", "relMSE", "FLIP", "SSIM", "PSNR", "bias"]) element("th", text, head);
    const body = table.createTBody();
    const add = (row, errors) => {
      for (const text of [scientific(errors.relmse), digits(errors.flip_ldr, 3), digits(errors.ssim, 4),
        errors.psnr_db === null ? "" : `${digits(errors.psnr_db, 3)} dB`, percent(errors.bias)]) {
        row.insertCell().append(text);
      }
    };
    const first = body.insertRow();
    first.className = "reference";
    for (const text of ["Matched reference", ""]) first.insertCell().textContent = text;
    add(first, final.matched_reference);
    for (const { curve, label, errors } of rows) {
      const row = body.insertRow();
      curveCell(row, curve);
      row.insertCell().textContent = label;
      add(row, errors);
    }
  };
  fill();
  onSchemeChange(fill);
})();
