// Colours and words of things as the pictures have them.
import { Color, MathUtils, SRGBColorSpace, type ColorRepresentation } from "three";

/** What looks_json() of tools/scene/looks.hpp says. Colours are 0xrrggbb. */
export interface SceneData {
  layers: { name: string; words: string }[];
  looks: Record<string, { layer: string; words: string; light: number; dark: number }>;
  reasons: { words: string; means: string; light: number }[];
  ramps: Record<RampName, number[]>; // 256 sRGB colours, three bytes each
}
export type RampName = "path" | "amount" | "score" | "error";

let scene: SceneData;

/** To be called once, before any colour is asked for. */
export function setLooks(ofScene: SceneData) { scene = ofScene; }

export const isDark = () => matchMedia("(prefers-color-scheme: dark)").matches;
const css = (colour: ColorRepresentation) => `#${new Color(colour).getHexString()}`;

/** What a legend calls a thing, and its colour. */
export const wordsOf = (name: string) => scene.looks[name].words;
export const colourOf = (name: string) => scene.looks[name][isDark() ? "dark" : "light"];
export const sceneLayers = () => scene.layers;

/** Light enough for a dark page, in which a colour made for paper would drown. */
function lightened(colour: ColorRepresentation): Color {
  const { h, s, l } = new Color(colour).getHSL({ h: 0, s: 0, l: 0 }, SRGBColorSpace);
  return new Color().setHSL(h, s, Math.max(l, 0.55), SRGBColorSpace);
}

export const onPage = (colour: ColorRepresentation) =>
  (isDark() ? lightened(colour) : new Color(colour));

/** The same for the style sheet, whatever the page is or will be; likewise of a thing. */
export const cssOnPage = (colour: ColorRepresentation) =>
  `light-dark(${css(colour)}, ${css(lightened(colour))})`;
export const cssOf = (name: string) =>
  `light-dark(${css(scene.looks[name].light)}, ${css(scene.looks[name].dark)})`;

/** Why a candidate was refused, by the reason's number. */
export const reason = (number: number) => scene.reasons[number];

export const hairline = () => (isDark() ? "#2a313b" : "#e6e9ee");

/** 0xrrggbb of a ramp at `t`, which is clamped to [0, 1]. */
export function rampHex(name: RampName, t: number): number {
  const at = 3 * Math.round(255 * MathUtils.clamp(t, 0, 1));
  const bytes = scene.ramps[name];
  return bytes[at] << 16 | bytes[at + 1] << 8 | bytes[at + 2];
}

export const ramp = (name: RampName, t: number) => new Color(rampHex(name, t));

export const rampGradient = (name: RampName) => `linear-gradient(90deg,${
  Array.from({ length: 17 }, (_, i) => css(rampHex(name, i / 16))).join()})`;
