// What everything in the 3D view means, in words beside its colour.
import { kBelievedColours, type BelievedKind } from "./believed";
import { planColour, rampGradient } from "./colours";
import { colourBar, make, measure, number, type Child } from "./dom";
import type { RunScene, Layers } from "./run_scene";
import { kNewColour, ofVoxels, type Colouring } from "./surfaces";
import { foundColours } from "./true_surface";

type Shape = "line" | "dot";

const hex = (colour: number) => `#${colour.toString(16).padStart(6, "0")}`;

function item(shape: Shape, colour: string, text: string, ...more: Child[]): HTMLElement {
  const swatch = make("i", { class: `mark ${shape}` });
  swatch.style.background = colour;
  return make("span", {}, swatch, text, ...more);
}

/** The colours of an order. */
function orderItem(first: string, last: string): HTMLElement {
  const swatch = make("i", { class: "mark bar" });
  swatch.style.background = rampGradient("path");
  return make("span", {}, first, swatch, last);
}

/** One text where all runs have the same, else each run's beside the colour of the run. */
function ofEach(scenes: RunScene[], texts: string[]): Child[] {
  if (new Set(texts).size === 1) return [` ${texts[0]}`];
  return scenes.map(({ flight }, i) => make("span", { class: "each" }, make("span", {
    class: `dot run-${flight.index}`, role: "img", "aria-label": flight.data.label }),
  ` ${texts[i]}`));
}

/** A bar with what it stands for under it, or where runs differ in that each run's ends. */
function amountItem(scenes: RunScene[], what: string, ends: string[][], unit: string) {
  if (new Set(ends.map((each) => each.join(" "))).size === 1) {
    return colourBar(rampGradient("amount"), what, ends[0], unit);
  }
  const swatch = make("i", { class: "mark bar" });
  swatch.style.background = rampGradient("amount");
  return make("span", {}, what, swatch, ...ofEach(scenes, ends.map((each) =>
    `${each[0]} to ${each[2]}`)), ` ${unit}`);
}

function errorItem(scenes: RunScene[], things: string): HTMLElement {
  const measured = scenes.filter(({ model }) => model.errors);
  const scales = measured.map(({ model }) => model.errors!);
  const bar = amountItem(measured, `${things}: off the surface by`, scales.map(({ most_mm }) =>
    [0, most_mm / 2, most_mm].map((mm) => number(mm, mm % 1 === 0 ? 0 : 1))),
  "mm or more; grey: not of the structure; median");
  return make("span", {}, ...bar.childNodes, ...ofEach(measured,
    scales.map(({ median_mm }) => measure(number(median_mm), "mm"))));
}

function ofColouring(scenes: RunScene[], by: Colouring, things: string): HTMLElement {
  if (by === "real") return item("dot", "#9a8f80", `${things}: camera colours`);
  if (by === "height") {
    return amountItem(scenes, `${things}: height`, scenes.map(({ model: { heights: [low, high] } }) =>
      [low, (low + high) / 2, high].map((z) => number(z, 1))), "m");
  }
  if (by === "error") return errorItem(scenes, things);
  if (by === "density") {
    const dense = scenes.filter(({ model }) => model.densities);
    if (dense.length === 0) return make("span", {}, "no voxels");
    return amountItem(dense, `${things}: density`, dense.map(({ model: { densities } }) => {
      const { most } = densities!;
      return ["0", number(most / 2, most < 10 ? 1 : 0), number(most)];
    }), `or more points a voxel of ${measure(number(dense[0].model.densities!.size, 2), "m")}`);
  }
  return orderItem(`${things}: found by first`, "last view");
}

/** Of the layers that are shown, after as many views as `viewsOf` says. */
export function legendItems(scenes: RunScene[], layers: Layers, by: Colouring,
    viewsOf: (scene: RunScene) => number): HTMLElement[] {
  if (scenes.length === 0) return [];
  return [...measuredItems(scenes, layers, by, viewsOf), ...surfaceItems(scenes, layers, by, viewsOf),
    ...flightItems(scenes, layers, scenes.some((scene) => viewsOf(scene) > 0)),
    ...layers.candidates ? candidateItems(scenes) : [], ...believedItems(scenes),
    make("span", {}, "grid",
      ...ofEach(scenes, scenes.map(({ gridStep_m }) => measure(number(gridStep_m), "m"))))];
}

// beside a surface nothing that was measured is drawn
const showsMeasured = (scenes: RunScene[]) => scenes.some((scene) => !scene.isSwiped());

function measuredItems(scenes: RunScene[], layers: Layers, by: Colouring,
    viewsOf: (scene: RunScene) => number): HTMLElement[] {
  const items: HTMLElement[] = [];
  const clouds = scenes.filter((scene) => scene.model.cloud);
  const coloured = clouds.length > 0 ? clouds : scenes;
  const isMeasured = showsMeasured(scenes);
  const [cloud, voxels] = [layers.cloud && isMeasured, layers.voxels && isMeasured];
  const pale = scenes.some(({ model }) => model.isFaded) ? "pale " : "";
  if (cloud && voxels && ofVoxels(by) === by && !pale) {
    items.push(ofColouring(coloured, by, "points, voxels"));
  } else {
    if (cloud) items.push(ofColouring(coloured, by, `${pale}points`));
    if (voxels) items.push(ofColouring(coloured, ofVoxels(by), "voxels"));
  }
  if (cloud && scenes.some((scene) => scene.model.newPoints(viewsOf(scene)) > 0)) {
    items.push(item("dot", hex(kNewColour), "points of this view"));
  }
  return items;
}

function surfaceItems(scenes: RunScene[], layers: Layers, by: Colouring,
    viewsOf: (scene: RunScene) => number): HTMLElement[] {
  const items: HTMLElement[] = [];
  const ofSurface = scenes.filter(({ surface }) => surface);
  const isKnown = ofSurface.length > 0;
  const sizes = () => [", voxels of", ...ofEach(ofSurface,
    ofSurface.map(({ surface }) => measure(number(surface!.size_m, 2), "m")))];
  if (isKnown && layers.found) {
    items.push(by === "iteration"
      ? orderItem("surface found by first", "last view")
      : item("dot", hex(foundColours.found), "surface found", ...sizes()));
  }
  if (isKnown && layers.missed) {
    const colour = by === "iteration" ? foundColours.missedInOrder : foundColours.missed;
    const isOver = ofSurface.every((scene) => viewsOf(scene) >= scene.flight.count);
    items.push(item("dot", hex(colour), isOver ? "surface missed" : "surface not found yet",
      ...sizes()));
    const compared = Math.max(...scenes.map((scene) => scene.compared()));
    if (compared > 0) {
      items.push(item("dot", hex(foundColours.onlyOther),
        `missed here, found by ${scenes.length > 2 ? "another" : "the other"} run`));
    }
  }
  if (layers.surface && scenes.some((scene) => scene.isSwiped())) {
    items.push(make("span", {}, "left of the line the true structure, without its texture, right of "
      + "it the surface made of the run's pictures"
      + (layers.cloud || layers.voxels ? "; points and voxels are not drawn beside them" : "")));
  }
  if (layers.structure && showsMeasured(scenes)) items.push(item("dot", "#b9bec6", "structure"));
  return items;
}

function flightItems(scenes: RunScene[], layers: Layers, hasViews: boolean): HTMLElement[] {
  const items: HTMLElement[] = [];
  if (layers.path && hasViews) items.push(orderItem("path, views: first", "last"));
  if (layers.frusta && hasViews) {
    items.push(item("line", rampGradient("path"), "pyramid of each view"));
  }
  if (layers.profile || (layers.path && !hasViews)) {
    items.push(item("line", "#8a95a3", "profile flight"));
  }
  if (layers.plan && scenes.some((scene) => scene.plan)) {
    items.push(item("line", hex(planColour()), "still planned"));
  }
  if (layers.vehicle) {
    items.push(item("dot", "#22272e", "vehicle, enlarged where it would be a speck"));
  }
  if (layers.vehicle && !layers.candidates && hasViews) {
    const sights = scenes.map((scene) => scene.sight());
    items.push(item("line", "#ff8a3c", "what the cameras see",
      ...sights.every(({ isWhole }) => isWhole) ? []
        : [" to", ...ofEach(scenes, sights.map(({ length_m }) =>
          measure(number(length_m, 1), "m")))]));
  }
  return items;
}

/** Each kind once, with the counts of all runs. */
function candidateItems(scenes: RunScene[]): HTMLElement[] {
  const deciding = scenes.filter((scene) => scene.candidates);
  const kinds = deciding.map((scene) => scene.candidates!.kinds());
  const all = new Map(kinds.flat().map((kind) => [kind.text, kind]));
  return [...all].map(([text, { colour, means }]) => {
    const counts = kinds.map((ofRun) =>
      number(ofRun.find((kind) => kind.text === text)?.count ?? 0));
    const named = item("line", colour, `${text}:`, ...ofEach(deciding, counts));
    named.title = means;
    return named;
  });
}

const kBelievedWords: Record<BelievedKind, string> = {
  unknown: "unknown voxels that its rays were to cross",
  predicted: "predicted ones that they were to meet first",
  frontier: "frontier voxels (seen, but thinly)",
  looked_at: "frontier that it was to look at" };

/** Each kind once; counted where there is one run. */
function believedItems(scenes: RunScene[]): HTMLElement[] {
  const shown = scenes.filter((scene) => scene.believed?.object.visible);
  const counts = shown.map((scene) => scene.believed!.counts());
  const kinds = (Object.keys(kBelievedWords) as BelievedKind[])
    .filter((kind) => counts.some((each) => each[kind] !== undefined));
  const coarse_m = Math.max(0, ...shown.map((scene) => scene.believed!.coarse_m() ?? 0));
  return [...kinds.map((kind) => item("dot", hex(kBelievedColours[kind]),
    kBelievedWords[kind] + (shown.length > 1 ? "" : `: ${number(counts[0][kind] ?? 0)}`))),
  ...coarse_m === 0 ? [] : [make("span", {},
    `these are drawn as cubes of ${number(coarse_m, 2)} m, so that the page can carry them`)]];
}
