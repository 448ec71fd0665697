// What everything in the 3D view means, in words beside its colour.
import { kBelievedKinds } from "./believed";
import { hex, look, rampGradient, type RampName } from "./colours";
import { colourBar, make, measure, number, ofRun, type Child } from "./dom";
import type { RunScene, Layers } from "./run_scene";
import { ofVoxels, type Colouring } from "./surfaces";

function item(shape: "line" | "dot" | "bar", colour: string, text: string, ...more: Child[]) {
  const swatch = make("i", { class: `mark ${shape}` });
  swatch.style.background = colour;
  return make("span", {}, swatch, text, ...more);
}

/** A thing as all pictures have it. */
const thing = (shape: "line" | "dot", name: string, ...more: Child[]) =>
  item(shape, hex(look(name).colour), look(name).words, ...more);

/** The colours of an order. */
const orderItem = (first: string, last: string) =>
  make("span", {}, first, item("bar", rampGradient("path"), ""), last);

/** One text where all runs have the same, else each run's beside the colour of the run. */
function ofEach(scenes: RunScene[], texts: string[]): Child[] {
  if (new Set(texts).size === 1) return [` ${texts[0]}`];
  return scenes.map(({ flight: { index, data } }, i) => {
    const dot = ofRun("dot", index);
    dot.role = "img";
    dot.ariaLabel = data.label;
    return make("span", { class: "each" }, dot, ` ${texts[i]}`);
  });
}

/** A bar with what it stands for under it, or where runs differ in that each run's ends. */
function amountItem(scenes: RunScene[], what: string, ends: string[][], unit: string,
    ramp: RampName = "amount") {
  if (new Set(ends.map((each) => each.join(" "))).size === 1) {
    return colourBar(rampGradient(ramp), what, ends[0], unit);
  }
  return make("span", {}, what, item("bar", rampGradient(ramp), ""),
    ...ofEach(scenes, ends.map((each) => `${each[0]} to ${each[2]}`)), ` ${unit}`);
}

function ofColouring(scenes: RunScene[], by: Colouring, things: string): HTMLElement {
  const texts = (low: number, high: number, decimals: number) =>
    [low, (low + high) / 2, high].map((value) => number(value, value % 1 === 0 ? 0 : decimals));
  if (by === "real") return item("dot", "#9a8f80", `${things}: camera colours`);
  if (by === "iteration") return orderItem(`${things}: found by first`, "last view");
  if (by === "height") {
    const ends = scenes.map(({ model: { heights: [low, high] } }) =>
      [low, (low + high) / 2, high].map((z) => number(z, 1)));
    return amountItem(scenes, `${things}: height`, ends, "m");
  }
  if (by === "error") {
    const measured = scenes.filter(({ flight }) => flight.data.cloud?.error);
    const clouds = measured.map(({ flight }) => flight.data.cloud!);
    const bar = amountItem(measured, `${things}: off the surface by`,
      clouds.map(({ error_most_mm }) => texts(0, error_most_mm, 1)),
      "mm or more; grey: not of the structure; median", "error");
    return make("span", {}, ...bar.childNodes, ...ofEach(measured,
      clouds.map(({ error_median_mm }) => measure(number(error_median_mm), "mm"))));
  }
  const dense = scenes.flatMap(({ model: { densities } }) => densities ?? []);
  if (dense.length === 0) return make("span", {}, "no voxels");
  return amountItem(scenes.filter(({ model }) => model.densities), `${things}: density`,
    dense.map(({ most }) => texts(0, most, most < 10 ? 1 : 0)),
    `or more points a voxel of ${measure(number(dense[0].voxels.size_m, 2), "m")}`);
}

/** Of the layers that are shown, after as many views as `viewsOf` says. */
export function legendItems(scenes: RunScene[], layers: Layers, by: Colouring,
    viewsOf: (scene: RunScene) => number): HTMLElement[] {
  if (scenes.length === 0) return [];
  return [...measuredItems(scenes, layers, by, viewsOf),
    ...surfaceItems(scenes, layers, by, viewsOf),
    ...flightItems(scenes, layers, scenes.some((scene) => viewsOf(scene) > 0)),
    ...layers.candidates ? candidateItems(scenes) : [], ...believedItems(scenes),
    make("span", {}, "grid",
      ...ofEach(scenes, scenes.map(({ flight }) => measure(number(flight.data.grid_m), "m"))))];
}

// beside a surface nothing that was measured is drawn
const showsMeasured = (scenes: RunScene[]) => scenes.some((scene) => !scene.isSwiped());

function measuredItems(scenes: RunScene[], layers: Layers, by: Colouring,
    viewsOf: (scene: RunScene) => number): HTMLElement[] {
  if (!showsMeasured(scenes)) return [];
  const clouds = scenes.filter(({ flight }) => flight.data.cloud);
  const coloured = clouds.length > 0 ? clouds : scenes;
  const pale = scenes.some(({ model }) => model.isFaded) ? "pale " : "";
  const areOne = layers.cloud && layers.voxels && ofVoxels(by) === by && !pale;
  return [
    areOne ? ofColouring(coloured, by, "points, voxels") : null,
    layers.cloud && !areOne ? ofColouring(coloured, by, `${pale}points`) : null,
    layers.voxels && !areOne ? ofColouring(coloured, ofVoxels(by), "voxels") : null,
    layers.cloud && scenes.some((scene) => scene.model.newPoints(viewsOf(scene)) > 0)
      ? thing("dot", "new_points") : null].filter((each) => each !== null);
}

function surfaceItems(scenes: RunScene[], layers: Layers, by: Colouring,
    viewsOf: (scene: RunScene) => number): HTMLElement[] {
  const items: HTMLElement[] = [];
  const ofSurface = scenes.filter(({ surface }) => surface);
  const sizes = () => [", voxels of", ...ofEach(ofSurface,
    ofSurface.map(({ surface }) => measure(number(surface!.size_m, 2), "m")))];
  if (ofSurface.length > 0 && layers.found) {
    items.push(by === "iteration" ? orderItem("surface found by first", "last view")
      : thing("dot", "found", ...sizes()));
  }
  if (ofSurface.length > 0 && layers.missed) {
    const { colour, words } = look(by === "iteration" ? "missed_in_order" : "missed");
    const isOver = ofSurface.every((scene) => viewsOf(scene) >= scene.flight.count);
    items.push(item("dot", hex(colour), isOver ? words : "surface not found yet", ...sizes()));
    if (scenes.some((scene) => scene.compared() > 0)) items.push(thing("dot", "only_other"));
  }
  if (layers.surface && scenes.some((scene) => scene.isSwiped())) {
    items.push(make("span", {}, "left of the line the true structure, without its texture, right "
      + "of it the surface made of the run's pictures"
      + (layers.cloud || layers.voxels ? "; points and voxels are not drawn beside them" : "")));
  }
  if (layers.structure && showsMeasured(scenes)) items.push(thing("dot", "structure"));
  return items;
}

function flightItems(scenes: RunScene[], layers: Layers, hasViews: boolean): HTMLElement[] {
  const items: HTMLElement[] = [];
  if (layers.path && hasViews) items.push(orderItem("path, views: first", "last"));
  if (layers.frusta && hasViews) {
    items.push(item("line", rampGradient("path"), "pyramid of each view"));
  }
  if (layers.profile || (layers.path && !hasViews)) items.push(thing("line", "profile"));
  if (layers.plan && scenes.some((scene) => scene.plan)) items.push(thing("line", "plan"));
  if (layers.vehicle) items.push(thing("dot", "hull", ", enlarged where it would be a speck"));
  if (layers.vehicle && !layers.candidates && hasViews) {
    const sights = scenes.map((scene) => scene.sight());
    const lengths = sights.map(({ length_m }) => measure(number(length_m, 1), "m"));
    items.push(thing("line", "camera", ...sights.every(({ isWhole }) => isWhole) ? []
      : [" to", ...ofEach(scenes, lengths)]));
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

/** Each kind once; counted where there is one run. */
function believedItems(scenes: RunScene[]): HTMLElement[] {
  const shown = scenes.filter((scene) => scene.believed?.object.visible);
  const counts = shown.map((scene) => scene.believed!.counts());
  const kinds = kBelievedKinds.filter((kind) => counts.some((each) => each[kind] !== undefined));
  const coarse_m = Math.max(0, ...shown.map((scene) => scene.believed!.coarse_m() ?? 0));
  return [...kinds.map((kind) => thing("dot", kind,
    shown.length > 1 ? "" : `: ${number(counts[0][kind] ?? 0)}`)),
  ...coarse_m === 0 ? [] : [make("span", {},
    `these are drawn as cubes of ${number(coarse_m, 2)} m, so that the page can carry them`)]];
}
