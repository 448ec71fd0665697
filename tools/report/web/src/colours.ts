// Colours of the page that stylesheets cannot give: of runs, lines and ramps.
import type { PageData, RampName } from "./data";

export const isDark = () => matchMedia("(prefers-color-scheme: dark)").matches;

const kRuns = {
  light: ["#2360d8", "#d9641a", "#16876a", "#a8328f", "#7d7a00", "#6846c7", "#c42b45", "#2f86a3"],
  dark: ["#6ea0ff", "#ff9a55", "#44c9a3", "#e37fd0", "#c9c44a", "#a78bfa", "#ff7a8c", "#67c3df"],
};

let slots: number[] = []; // of the runs

/** To be called once, before any colour is asked for. */
export function setSlots(ofRuns: number[]) { slots = ofRuns; }

/** Of one of several lines of the same run. */
export function lineColour(index: number): string {
  const colours = isDark() ? kRuns.dark : kRuns.light;
  return colours[index % colours.length];
}

/** Of a run in all plots, tables and views; tells eight apart. */
export function runColour(index: number): string { return lineColour(slots[index] ?? index); }

export const paleInk = () => (isDark() ? "#98a2b0" : "#667080");
export const hairline = () => (isDark() ? "#2a313b" : "#e6e9ee");
export const faintLine = () => (isDark() ? "#4a5462" : "#b3bcc8");
export const phaseShade = () => (isDark() ? "rgba(255,170,80,0.13)" : "rgba(230,140,40,0.14)");
/** Of what is still to come: nothing that was flown has it. */
export const planColour = () => (isDark() ? 0x49d6cf : 0x0a8f8a);

type Rgb = [number, number, number];

const kRamps: Record<RampName, Uint8Array> = {
  path: new Uint8Array(), amount: new Uint8Array(), score: new Uint8Array(),
};

/** To be called once, before any colour is asked for. */
export function setRamps(ramps: PageData["ramps"]) {
  for (const name of ["path", "amount", "score"] as const) kRamps[name] = Uint8Array.from(ramps[name]);
}

/** sRGB bytes of 256 colours, one after the other. */
export const rampTable = (name: RampName) => kRamps[name];

/** The one at `t`, clamped to [0, 1]. */
export function ramp(name: RampName, t: number): Rgb {
  const at = 3 * Math.round(255 * Math.min(Math.max(t, 0), 1));
  const [r, g, b] = kRamps[name].subarray(at, at + 3);
  return [r, g, b];
}

export function rampGradient(name: RampName): string {
  const stops = Array.from({ length: 17 }, (_, i) => `rgb(${ramp(name, i / 16).join(",")})`);
  return `linear-gradient(90deg,${stops.join(",")})`;
}
