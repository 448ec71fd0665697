// The page's state in the URL's hash, so that a link shows what its sender saw.
import { kEfforts, type Effort } from "./clock";

export interface PageState {
  effort: Effort;
  at: number; // not finite: the end, wherever that will be
  camera: number[]; // position and target
  layers: string[];
  colour: string;
  runs: number[];
}

/** Of a hash; what it does not say, or says wrongly, is left out. */
export function readState(hash: string): Partial<PageState> {
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  const list = (key: string) => words.get(key)?.split(",").filter((word) => word !== "");
  const numbers = (key: string, count?: number) => {
    const all = list(key)?.map(Number);
    return all?.every(Number.isFinite) && all.length === (count ?? all.length) ? all : undefined;
  };
  return { effort: kEfforts.find(([effort]) => effort === words.get("by"))?.[0],
    at: numbers("at")?.[0], camera: numbers("camera", 6),
    layers: list("layers"), // of none: all are off
    colour: words.get("colour") ?? undefined, runs: numbers("runs") };
}

export function hashOf({ effort, at, camera, layers, colour, runs }: PageState): string {
  const short = (x: number) => String(Number(x.toFixed(3)));
  const words = new URLSearchParams({ by: effort, ...Number.isFinite(at) ? { at: short(at) } : {},
    ...camera.length > 0 ? { camera: camera.map(short).join() } : {}, layers: layers.join(), colour,
    runs: runs.join() });
  return `#${words}`.replaceAll("%2C", ",");
}
