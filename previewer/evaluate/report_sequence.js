// SPDX-License-Identifier: Apache-2.0
// How steady each way of rendering is from frame to frame, where the frames are a sequence.
"use strict";
(() => {
  const { results, byId, curveCell, digits, scientific, element, onSchemeChange } = report;
  const rows = results.curves.flatMap((curve) => curve.points.filter((point) => point.sequence)
    .map((point) => ({ curve, point, figures: point.sequence })));
  if (!results.sequence || rows.length === 0) {
    byId("sequence-section").hidden = true;
    return;
  }
  const share = (value) => `${digits(100 * value, 3)} %`;
  const plain = (value) => digits(value, 3);
  const first = (rows.find((row) => row.figures.flip_step_mean !== null) ?? rows[0]).figures;
  // What the reference has itself is the same for every point.
  const columns = [
    { key: "flip_step_mean", name: "FLIP step", text: plain, of_reference: first.flip_step_reference_mean,
      meaning: "mean FLIP between a frame and the one before: what a viewer notices, of movement and of flicker alike. " +
        "As much as the reference's is the movement's; what is above it flickers." },
    { key: "flip_step_max", name: "largest", text: plain, of_reference: first.flip_step_reference_max,
      meaning: "the largest such step: a single jump." },
    { key: "tid_relative", name: "TID", text: share,
      of_reference: first.tid_reference > 0 ? first.tid_reference / first.mean_luminance : first.tid_reference,
      meaning: "temporal image difference (Barák et al., 2013): how much a point of a surface changes its luminance from frame " +
        "to frame wherever it moves to, root mean square over the mean luminance. Light that really moves is in it, as in the " +
        "reference's." },
    { key: "flicker_power", name: "flicker", text: scientific, of_reference: null,
      meaning: "energy of the error (picture less reference) in periods shorter than four frames, over the squared mean " +
        "luminance: 0.0001 is an error that jumps to and fro by 1 % of it. The reference's own noise is in it." },
    { key: "flicker_share", name: "of all change", text: share, of_reference: null,
      meaning: "the same over the energy of all periods: near 100 % the error flickers, near 0 it drifts." },
  ].filter((column) => rows.some((row) => row.figures[column.key] !== null));

  const { step, motion } = results.sequence;
  byId("sequence-note").textContent = `${results.frames.length} frames, ${step === 1 ? "one after the other" : `at a step of ${step}`}. ` +
    "Lower is steadier. Click a heading to sort." +
    (step !== 1 ? " TID needs frames that follow each other one by one." : motion ? "" : " TID is not known: the layer motion could not be drawn.") +
    (motion && first.tid_coverage !== null ? ` ${share(first.tid_coverage)} of the pixels have their point in the frame before and count for TID.` : "") +
    (results.frames.length < 8 ? " Flicker needs eight frames." : "") +
    (results.curves.some((curve) => curve.reference_engine)
      ? " Cycles' points have one seed in all frames, as by Blender's default: their noise stands still where nothing moves."
      : "");
  for (const column of columns) {
    element("dt", column.name, byId("sequence-meanings"));
    element("dd", column.meaning, byId("sequence-meanings"));
  }

  let sorted = { column: null, rising: true };
  const inOrder = () => {
    if (!sorted.column) return rows;
    // What is not a number comes last, whichever way.
    const value = (row) => row.figures[sorted.column.key] ?? (sorted.rising ? Infinity : -Infinity);
    return [...rows].sort((a, b) => (value(a) === value(b) ? 0 : (value(a) < value(b)) === sorted.rising ? -1 : 1));
  };
  const fill = () => {
    const table = byId("sequence");
    table.replaceChildren();
    const head = table.createTHead().insertRow();
    for (const text of ["curve", "point"]) element("th", text, head);
    for (const column of columns) {
      const heading = element("th", "", head);
      if (sorted.column === column) heading.setAttribute("aria-sort", sorted.rising ? "ascending" : "descending");
      const button = element("button", column.name, heading);
      button.type = "button";
      button.addEventListener("click", () => {
        sorted = { column, rising: sorted.column === column ? !sorted.rising : true };
        fill();
      });
    }
    const body = table.createTBody();
    const reference = body.insertRow();
    reference.className = "reference";
    for (const text of ["Reference itself", "", ...columns.map((column) => (column.of_reference === null ? "–" : column.text(column.of_reference)))]) {
      reference.insertCell().textContent = text;
    }
    for (const { curve, point, figures } of inOrder()) {
      const row = body.insertRow();
      curveCell(row, curve);
      row.insertCell().textContent = point.label;
      for (const column of columns) {
        const cell = row.insertCell();
        cell.textContent = figures[column.key] === null ? "not a number" : column.text(figures[column.key]);
        if (column.key === "flip_step_max") element("small", `frame ${figures.flip_step_max_frame}`, cell);
      }
    }
  };
  fill();
  onSchemeChange(fill);
})();
