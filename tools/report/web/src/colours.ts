// Colours of the page that stylesheets cannot give: of runs, lines and ramps.

export const isDark = () => matchMedia("(prefers-color-scheme: dark)").matches;

const kRuns = {
  light: ["#2360d8", "#d9641a", "#16876a", "#a8328f", "#7d7a00", "#6846c7", "#c42b45", "#2f86a3"],
  dark: ["#6ea0ff", "#ff9a55", "#44c9a3", "#e37fd0", "#c9c44a", "#a78bfa", "#ff7a8c", "#67c3df"],
};

/** Of a run in all plots, tables and views; tells the first eight apart. */
export function runColour(index: number): string {
  const colours = isDark() ? kRuns.dark : kRuns.light;
  return colours[index % colours.length];
}

/** Of one of several lines of the same run. */
export function lineColour(index: number): string { return runColour(index); }

export const ink = () => (isDark() ? "#e8ebf0" : "#1d232c");
export const paleInk = () => (isDark() ? "#98a2b0" : "#667080");
export const hairline = () => (isDark() ? "#2a313b" : "#e6e9ee");
export const faintLine = () => (isDark() ? "#4a5462" : "#b3bcc8");
export const phaseShade = () => (isDark() ? "rgba(255,170,80,0.13)" : "rgba(230,140,40,0.14)");
export const nowLine = () => (isDark() ? "#ffffff" : "#11151b");

type Rgb = [number, number, number];
const rgbOf = (hex: number): Rgb => [hex >> 16, hex >> 8 & 255, hex & 255];

/** Piecewise linear, even in lightness from first to last: what comes later is lighter. */
export type RampName = "order" | "height" | "density";
const kRamps: Record<RampName, Rgb[]> = {
  order: [0x4a2bc2, 0x8a2bb8, 0xc2379a, 0xe85d6b, 0xf68d45, 0xf9c440].map(rgbOf),
  height: [0x2b5c8a, 0x2e86ab, 0x3fb0a0, 0x8ccf7e, 0xe3dd6a].map(rgbOf),
  density: [0x40318a, 0x2f6fae, 0x24a49a, 0x7ed06a, 0xf4e04d].map(rgbOf),
};

/** sRGB bytes at `t`, clamped to [0, 1]. */
export function ramp(name: RampName, t: number): Rgb {
  const colours = kRamps[name];
  const x = Math.min(Math.max(t, 0), 1) * (colours.length - 1);
  const i = Math.min(Math.floor(x), colours.length - 2);
  return [0, 1, 2].map((k) =>
    Math.round(colours[i][k] + (x - i) * (colours[i + 1][k] - colours[i][k]))) as Rgb;
}

/** 256 colours of a ramp, one after the other. */
export function rampTable(name: RampName): Uint8Array {
  return Uint8Array.from(Array.from({ length: 256 }, (_, i) => ramp(name, i / 255)).flat());
}

export function rampGradient(name: RampName): string {
  return `linear-gradient(90deg,${kRamps[name].map((c) => `rgb(${c.join(",")})`).join(",")})`;
}
