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
  const numbers = (text: string | null) => {
    const all = text?.split(",").map(Number) ?? [];
    return text !== null && text !== "" && all.every(Number.isFinite) ? all : undefined;
  };
  const effort = words.get("by");
  if (effort === "views" || effort === "metres" || effort === "seconds") state.effort = effort;
  state.at = numbers(words.get("at"))?.[0];
  const camera = numbers(words.get("camera"));
  if (camera?.length === 6) state.camera = camera;
  const layers = words.get("layers");
  if (layers !== null) state.layers = layers.split(",");
  state.colour = words.get("colour") ?? undefined;
  state.runs = numbers(words.get("runs"));
  return state;
}

export function hashOf(state: Required<PageState>): string {
  const short = (x: number) => String(Number(x.toFixed(3)));
  return "#" + [["by", state.effort], ["at", Number.isFinite(state.at) ? short(state.at) : ""],
    ["camera", state.camera.map(short).join(",")], ["layers", state.layers.join(",")],
    ["colour", state.colour], ["runs", state.runs.join(",")]]
    .filter(([, value]) => value !== "")
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
