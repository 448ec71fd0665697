// The page's state in the URL's hash, so that a link shows what its sender saw.
import type { Effort } from "./clock";

export interface PageState {
  effort?: Effort;
  at?: number;
  camera?: number[]; // position and target
  layers?: string[];
  colour?: string;
  runs?: number[];
}

/** Of a hash; what it does not say, or says wrongly, is left out. */
export function readState(hash: string): PageState {
  const state: PageState = {};
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  const list = (key: string) => words.get(key)?.split(",").filter((word) => word !== "");
  const numbers = (key: string) => {
    const all = list(key)?.map(Number);
    return all?.every(Number.isFinite) ? all : undefined;
  };
  const effort = words.get("by");
  if (effort === "views" || effort === "metres" || effort === "seconds") state.effort = effort;
  state.at = numbers("at")?.[0];
  const camera = numbers("camera");
  if (camera?.length === 6) state.camera = camera;
  state.layers = list("layers"); // of none, all are off
  state.colour = words.get("colour") ?? undefined;
  state.runs = numbers("runs");
  return state;
}

export function hashOf(state: Required<PageState>): string {
  const short = (x: number) => String(Number(x.toFixed(3)));
  return "#" + [["by", state.effort], ["at", Number.isFinite(state.at) ? short(state.at) : null],
    ["camera", state.camera.length > 0 ? state.camera.map(short).join(",") : null],
    ["layers", state.layers.join(",")], ["colour", state.colour], ["runs", state.runs.join(",")]]
    .filter((each): each is [string, string] => each[1] !== null) // an empty list is one, too
    .map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll("%2C", ",")}`).join("&");
}

/** Writes the state some moments after it has changed last. */
export class StateWriter {
  private timer = 0;

  constructor(private readonly state: () => Required<PageState>) {}

  change() {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.write(), 400);
  }

  write() { history.replaceState(null, "", hashOf(this.state())); }
}
