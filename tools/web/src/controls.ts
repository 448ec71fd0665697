// What moves the replay and chooses what is shown: slider, play button, keys, layers, colours.
import { kEfforts, type Clock, type Effort } from "./clock";
import { sceneLayers } from "./colours";
import { choice, make, select, toggle } from "./dom";
import { lastAtMost, type Flight } from "./flight";
import type { PageState } from "./permalink";
import type { Layers, RunScene } from "./run_scene";
import type { Stage } from "./stage";
import type { Colouring } from "./surfaces";

/** A whole replay at speed 1: half a second a view, but neither a flash nor an evening. */
const replayLasts_s = (views: number) => Math.min(Math.max(0.5 * views, 8), 60);

/** The replay itself: playing, stepping, and the way from one effort to another. */
export class Replay {
  private flights: Flight[] = [];
  private playing = 0; // number of the present way of playing: older ones end
  speed = 1;

  constructor(readonly clock: Clock) {}

  setFlights(flights: Flight[]) {
    this.flights = flights;
    this.clock.set({ at: Math.min(Math.max(this.clock.at, this.begin()), this.last()) });
  }

  /**
   * After the profile. Metres and seconds may be 0 at the first view, too, so that the moment
   * before has a place of its own, a hundredth of the mission before 0.
   */
  begin(effort: Effort = this.clock.effort): number {
    return effort === "views" ? 0 : -Math.max(0.01 * this.last(effort), 1e-3);
  }

  /** Of the longest run. */
  last(effort: Effort = this.clock.effort): number {
    return Math.max(0, ...this.flights.map((flight) => flight.last(effort)));
  }

  /** The same moment of the first run, measured otherwise. */
  setEffort(effort: Effort) {
    const [lead] = this.flights;
    const n = lead ? lead.viewsAt(this.clock) : 0;
    const at = lead && n > 0 ? lead.effort(n, effort) : this.begin(effort);
    this.clock.set({ effort, at, isPlaying: false });
  }

  /** To the next or an earlier view of any run. */
  step(views: number) {
    const { clock } = this;
    if (clock.effort === "views") {
      this.moveTo(Math.round(clock.at) + views);
      return;
    }
    const all = this.flights.flatMap((flight) => Array.from(
      { length: flight.count }, (_, n) => flight.effort(n + 1, clock.effort)));
    const stops = [...new Set([this.begin(), ...all])].sort((a, b) => a - b);
    const here = lastAtMost(stops, clock.at + 1e-9);
    this.moveTo(stops[Math.min(Math.max(here + views, 0), stops.length - 1)] ?? this.begin());
  }

  moveTo(at: number) {
    this.clock.set({ at: Math.min(Math.max(at, this.begin()), this.last()), isPlaying: false });
  }

  toggle() {
    const { clock } = this;
    if (clock.isPlaying) {
      // rests at a view, not between two
      this.moveTo(clock.effort === "views" ? Math.floor(clock.at + 1e-9) : clock.at);
      return;
    }
    clock.set({ isPlaying: true, at: clock.at >= this.last() ? this.begin() : clock.at });
    const playing = ++this.playing;
    const lasts_s = replayLasts_s(this.last("views"));
    let before = performance.now();
    const advance = (now: number) => {
      if (!clock.isPlaying || playing !== this.playing) return;
      const at = clock.at + this.speed * this.last() * (now - before) / 1000 / lasts_s;
      before = now;
      if (at >= this.last()) { this.moveTo(this.last()); return; }
      clock.set({ at });
      requestAnimationFrame(advance);
    };
    requestAnimationFrame(advance);
  }
}

/** Arrows, Page keys, Home, End and space, wherever no other control wants them. */
export function listenToKeys(replay: Replay) {
  addEventListener("keydown", (event) => {
    const target = event.target as HTMLElement;
    const isSlider = target.matches("input[type=range]");
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (target.matches("select, textarea, pre, input[type=number]")) return;
    if (event.key === " " && target.matches("summary, button, input[type=checkbox]")) return;
    const large = Math.max(1, Math.round(replay.last("views") / 20));
    const actions: Record<string, () => void> = {
      ArrowRight: () => replay.step(event.shiftKey ? 10 : 1),
      ArrowLeft: () => replay.step(event.shiftKey ? -10 : -1),
      " ": () => replay.toggle(),
    };
    if (isSlider) {
      Object.assign(actions, {
        PageUp: () => replay.step(large),
        PageDown: () => replay.step(-large),
        Home: () => replay.moveTo(replay.begin()),
        End: () => replay.moveTo(replay.last()),
      });
    }
    const action = actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}

export function makeTransport(replay: Replay, readout: HTMLElement): HTMLElement {
  const { clock } = replay;
  const play = make("button", { type: "button", class: "play", click: () => replay.toggle() });
  const slider = make("input", { type: "range", "aria-label": "Replay of the mission" });
  slider.addEventListener("input", () => replay.moveTo(Number(slider.value)));
  const efforts = choice("Measure the mission by", kEfforts,
    (effort) => replay.setEffort(effort));
  const update = () => {
    slider.step = clock.effort === "views" ? "1" : "any";
    slider.min = String(replay.begin());
    slider.max = String(replay.last());
    slider.value = String(clock.at);
    const all = replay.last() - replay.begin();
    const share = all > 0 ? 100 * (clock.at - replay.begin()) / all : 0;
    slider.style.setProperty("--done", `${share}%`);
    slider.setAttribute("aria-valuetext", readout.textContent ?? "");
    play.setAttribute("aria-label", clock.isPlaying ? "Pause" : "Play");
    play.classList.toggle("playing", clock.isPlaying);
    efforts.press(clock.effort); // a link chooses, too
  };
  clock.onChange(update);
  update();
  const speeds: [string, string][] = [["0.5", "½×"], ["1", "1×"], ["2", "2×"], ["4", "4×"]];
  return make("div", { class: "transport" }, play, slider,
    select("Speed of the replay", speeds, "1", (value) => { replay.speed = Number(value); }),
    efforts.element);
}

const kColourings: [Colouring, string][] = [["real", "Camera colours"], ["height", "Height"],
  ["density", "Density"], ["iteration", "Order of views"], ["error", "Error"]];
/** Of those that there is anything for; the others are asked for. */
const kShownFirst = ["cloud", "structure", "path", "plan", "vehicle"];

export interface Chosen {
  layers: Layers;
  colour: Colouring;
}

/** What is shown at first; where a link chooses, that. */
export function firstChoice(scenes: RunScene[], state: PageState): Chosen {
  const layers = Object.fromEntries(sceneLayers().map(({ name }) => [name,
    state.layers ? state.layers.includes(name)
      : kShownFirst.includes(name) && scenes.some((scene) => scene.has(name))]));
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
    })),
    make("span", { class: "tools" },
      select("Colour of points and voxels", colourings(scenes), chosen.colour, (by) => {
        chosen.colour = by;
        stage.colour(by);
        changed();
      }),
      make("button", { type: "button", class: "small", click: () => stage.frame(),
        title: "Show everything that is shown; a double click does it, too" }, "Fit"),
      ...stage.buttons()));
}
