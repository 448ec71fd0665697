// What moves the replay and chooses what is shown: slider, play button, keys, layers, colours.
import { kEfforts, type Clock } from "./clock";
import { sceneLayers } from "./colours";
import { make, select, toggle } from "./dom";
import type { PageState } from "./permalink";
import type { Layers, RunScene } from "./run_scene";
import type { Stage } from "./stage";
import type { Colouring } from "./surfaces";

/** Arrows and space, wherever no other control wants them. */
export function listenToKeys(clock: Clock) {
  addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (target.matches("select, textarea, pre, input[type=number]")) return;
    if (event.key === " " && target.matches("summary, button, input[type=checkbox]")) return;
    const views = event.shiftKey ? 10 : 1;
    if (event.key === "ArrowRight") clock.step(views);
    else if (event.key === "ArrowLeft") clock.step(-views);
    else if (event.key === " ") clock.toggle();
    else return;
    event.preventDefault();
  });
}

export function makeTransport(clock: Clock, readout: HTMLElement): HTMLElement {
  const play = make("button", { class: "play", click: () => clock.toggle() });
  const slider = make("input", { type: "range", "aria-label": "Replay of the mission",
    input: () => clock.moveTo(Number(slider.value)) });
  const efforts = kEfforts.map(([value, text]) =>
    make("button", { value, click: () => clock.setEffort(value) }, text));
  const update = () => {
    slider.step = clock.effort === "views" ? "1" : "any";
    slider.min = String(clock.begin());
    slider.max = String(clock.last());
    slider.value = String(clock.at);
    slider.setAttribute("aria-valuetext", readout.textContent ?? "");
    play.setAttribute("aria-label", clock.isPlaying ? "Pause" : "Play");
    play.textContent = clock.isPlaying ? "\u23f8\ufe0e" : "\u25b6\ufe0e";
    for (const [i, [value]] of kEfforts.entries()) {
      efforts[i].ariaPressed = String(value === clock.effort);
      efforts[i].hidden = !clock.knows(value);
    }
  };
  clock.onChange(update);
  update();
  const speeds: [string, string][] = [["0.5", "½×"], ["1", "1×"], ["2", "2×"], ["4", "4×"]];
  return make("div", { class: "transport" }, play, slider,
    select("Speed of the replay", speeds, "1", (value) => { clock.speed = Number(value); }),
    make("div", { class: "choice", role: "group", "aria-label": "Measure the mission by" },
      ...efforts));
}

const kColourings: [Colouring, string][] = [["real", "Camera colours"], ["height", "Height"],
  ["density", "Density"], ["iteration", "Order of views"], ["error", "Error"]];
/** Of those that there is anything for; the others are asked for. */
const kShownFirst = ["cloud", "structure", "path", "plan", "vehicle"];

interface Chosen {
  layers: Layers;
  colour: Colouring;
}

/** What is shown at first; where a link chooses, that. */
export function firstChoice(scenes: RunScene[], state: Partial<PageState>): Chosen {
  const layers = Object.fromEntries(sceneLayers().map(({ name }) => [name,
    state.layers?.includes(name)
      ?? (kShownFirst.includes(name) && scenes.some((scene) => scene.has(name)))]));
  const colours = colourings(scenes).map(([by]) => by);
  return { layers, colour: colours.find((by) => by === state.colour) ?? colours[0] };
}

function colourings(scenes: RunScene[]): [Colouring, string][] {
  const clouds = scenes.map(({ flight }) => flight.data.cloud).filter((cloud) => cloud !== null);
  const has = { // of all that have points: pictures side by side should mean the same
    real: clouds.length > 0 && clouds.every(({ colour }) => colour),
    error: clouds.some(({ error }) => error) };
  return kColourings.filter(([by]) => (by !== "real" && by !== "error") || has[by]);
}

/** Changes what is chosen, and tells. */
export function makeLayerBar(scenes: RunScene[], stage: Stage, chosen: Chosen,
    changed: () => void): HTMLElement {
  const layers = sceneLayers().filter(({ name }) => scenes.some((scene) => scene.has(name)));
  return make("div", { class: "layers", role: "group", "aria-label": "What the 3D view shows" },
    ...layers.map(({ name, words }) => toggle(words, chosen.layers[name], (on) => {
      chosen.layers[name] = on;
      stage.setLayers(chosen.layers);
      changed();
    }, name)),
    make("span", { class: "tools" },
      select("Colour of points and voxels", colourings(scenes), chosen.colour, (by) => {
        chosen.colour = by;
        stage.colour(by);
        changed();
      }), ...stage.buttons()));
}
