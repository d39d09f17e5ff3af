// SPDX-License-Identifier: Apache-2.0
// Two pictures of a frame side by side or with a wipe, and maps of where one of them differs from the reference.
"use strict";
(() => {
  const { results, pictures, byId, best, digits, scientific, time, percent, element, tabs } = report;
  const view = results.view;
  byId("frames-note").textContent = `Shown through ${view.transform}` +
    `${view.look && view.look !== "None" ? ` (${view.look})` : ""}` +
    `${view.exposure ? `, ${view.exposure} stops` : ""}. Of each way of rendering the most exact point; of Cycles the ` +
    "one whose time is nearest. Drag over the picture to wipe; click a map for its pixels.";
  if (pictures.length === 0 || pictures[0].previews.length === 0) return;

  const k_reference = "Reference";
  const nameOf = (preview) => `${preview.curve}, ${preview.label}`;
  const k_final = "Final render";
  const names = pictures[0].previews.map(nameOf).concat(k_reference, results.final_render ? [k_final] : []);
  // The point that the cards tell of, where its picture is here.
  const first = best && names.includes(`${best.curve}, ${best.label}`) ? `${best.curve}, ${best.label}` : names[0];
  const state = { frame: 0, left: first, right: k_reference };

  // The picture of that name in the frame that is shown, with its figures.
  const pictureOf = (name) => {
    const frame = pictures[state.frame];
    if (name === k_reference) {
      const reference = results.reference.frames[state.frame];
      return { image: frame.reference, tag: "Reference",
        caption: results.reference.engine === "Cycles (CPU)"
          ? `Reference: Cycles, ${reference.spp} spp, ${time(reference.seconds)}` : "Reference" };
    }
    if (name === k_final) {
      const render = results.final_render.frames[state.frame];
      return { image: frame.final_render, tag: k_final,
        caption: `${k_final}: Cycles by the scene's own light paths, ${render.spp} spp, ${time(render.seconds)}` };
    }
    const preview = frame.previews.find((item) => nameOf(item) === name);
    const point = results.curves.find((curve) => curve.name === preview.curve)
      .points.find((item) => item.label === preview.label).frames.find((item) => item.frame === frame.frame);
    return { ...preview, tag: name, flip_ldr: point.flip_ldr,
      caption: `${name}: ${time(point.seconds)}, relMSE ${scientific(point.relmse)}, FLIP ${digits(point.flip_ldr, 3)}` +
        `${point.flip_hdr === null ? "" : ` (HDR ${digits(point.flip_hdr, 3)})`}, bias ${percent(point.bias)}` };
  };
  const place = (id, source, text) => { byId(id).src = source; byId(id).alt = text; };

  const show = () => {
    for (const side of ["left", "right"]) {
      const picture = pictureOf(state[side]);
      place(`${side}-image`, picture.image, picture.tag);
      byId(`${side}-tag`).textContent = picture.tag;
      byId(`${side}-caption`).textContent = picture.caption;
    }
    // Maps of the picture that is neither the reference nor the final render: of the left one where both are such.
    const hasMaps = (name) => name !== k_reference && name !== k_final;
    const name = hasMaps(state.left) ? state.left : state.right;
    byId("maps").hidden = !hasMaps(name);
    if (hasMaps(name)) {
      const picture = pictureOf(name);
      place("difference", picture.difference, `Difference of ${name}`);
      place("flip", picture.flip, `FLIP of ${name}`);
      byId("difference-caption").textContent = `${name}: difference to the reference on the screen, four times`;
      byId("flip-caption").textContent = `${name}: FLIP, mean ${digits(picture.flip_ldr, 3)}; 0`;
      element("span", "", byId("flip-caption")).className = "scale";
      byId("flip-caption").append("1");
    }
  };
  const wipe = () => {
    const share = byId("wipe").value / 10;
    const whole = byId("stage").dataset.mode !== "wipe";
    byId("right-image").style.clipPath = whole ? "none" : `inset(0 0 0 ${share}%)`;
    byId("handle").style.left = `${share}%`;
  };
  for (const side of ["left", "right"]) {
    for (const name of names) element("option", name, byId(side)).value = name;
    byId(side).value = state[side];
    byId(side).addEventListener("change", () => { state[side] = byId(side).value; show(); });
  }
  byId("wipe").addEventListener("input", wipe);
  tabs(byId("frame-tabs"), pictures.map((item) => `Frame ${item.frame}`), 0, (index) => { state.frame = index; show(); });
  tabs(byId("mode-tabs"), ["Wipe", "Side by side"], 0, (index) => {
    byId("stage").dataset.mode = ["wipe", "side"][index];
    wipe();
  });

  // Few pixels are shown as such, not smeared.
  const markSmall = (image) =>
    image.classList.toggle("small", image.naturalWidth > 0 && image.clientWidth > 2 * image.naturalWidth);
  for (const image of document.querySelectorAll(".stage img, .maps img")) {
    image.addEventListener("load", () => markSmall(image));
  }
  const zoom = byId("zoom");
  for (const image of document.querySelectorAll(".maps img")) {
    image.addEventListener("click", () => { zoom.firstElementChild.src = image.src; zoom.showModal(); });
  }
  zoom.addEventListener("click", () => zoom.close());
})();
