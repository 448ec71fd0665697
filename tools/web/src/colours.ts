// Colours and words of things as the pictures have them, and the colours of runs.
import { Color, SRGBColorSpace, type ColorRepresentation } from "three";

/** What looks_json() of tools/scene/looks.hpp says. Colours are 0xrrggbb. */
export interface SceneData {
  layers: { name: string; words: string }[];
  looks: Record<string, { layer: string; words: string; light: number; dark: number }>;
  reasons: { words: string; means: string; light: number }[];
  ramps: Record<RampName, number[]>; // 256 sRGB colours, three bytes each
}
export type RampName = "path" | "amount" | "score" | "error";

let scene: SceneData;
let runs: string[] = []; // colours

/** To be called once, before any colour is asked for. */
export function setLooks(ofScene: SceneData, ofRuns: string[]) {
  [scene, runs] = [ofScene, ofRuns];
}

export const isDark = () => matchMedia("(prefers-color-scheme: dark)").matches;
export const hex = (colour: number) => `#${colour.toString(16).padStart(6, "0")}`;

/** The colour of a thing, and what a legend calls it. */
export function look(name: string): { colour: number; words: string } {
  const { light, dark, words } = scene.looks[name];
  return { colour: isDark() ? dark : light, words };
}
export const colourOf = (name: string) => look(name).colour;
export const sceneLayers = () => scene.layers;

/** Light enough for a dark page, in which a colour made for paper would drown. */
export function onPage(colour: ColorRepresentation): Color {
  const shown = new Color(colour);
  const { h, s, l } = shown.getHSL({ h: 0, s: 0, l: 0 }, SRGBColorSpace);
  return isDark() ? shown.setHSL(h, s, Math.max(l, 0.55), SRGBColorSpace) : shown;
}

/** Why a candidate was refused, by the reason's number. */
export const reason = (number: number) => scene.reasons[number];

/** Of a run in all plots, tables and views. */
export const runColour = (run: number) => `#${onPage(runs[run]).getHexString()}`;

export const paleInk = () => (isDark() ? "#98a2b0" : "#667080");
export const hairline = () => (isDark() ? "#2a313b" : "#e6e9ee");

/** sRGB bytes of 256 colours, one after the other. */
export const rampTable = (name: RampName) => scene.ramps[name];

/** Where in that table the colour at `t` begins; `t` is clamped to [0, 1]. */
export const rampAt = (t: number) => 3 * Math.round(255 * Math.min(Math.max(t, 0), 1));

export function ramp(name: RampName, t: number): Color {
  const [r, g, b] = scene.ramps[name].slice(rampAt(t), rampAt(t) + 3);
  return new Color().setRGB(r / 255, g / 255, b / 255, SRGBColorSpace);
}

export function rampGradient(name: RampName): string {
  const stops = Array.from({ length: 17 }, (_, i) => `#${ramp(name, i / 16).getHexString()}`);
  return `linear-gradient(90deg,${stops.join(",")})`;
}
