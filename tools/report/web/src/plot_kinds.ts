// Which plots there are, and how their values are written.
import { significant } from "./dom";
import type { Clock } from "./clock";
import type { Flight } from "./flight";
import * as specs from "./plot_specs";

export const kUnits = { views: "views", metres: "m", seconds: "s" };
export const kEffortNames = { views: "Views", metres: "Metres from the first view on, straight",
  seconds: "Seconds from the first view on" };

export interface PlotKind {
  title: string;
  unit: (flights: Flight[], choices: specs.PlotChoices) => string;
  content: (flights: Flight[], clock: Clock, choices: specs.PlotChoices) => specs.PlotContent;
  decimals: number | "significant";
  control?: "size" | "term";
  note?: string;
}

export const kKinds: PlotKind[] = [
  { title: "Coverage", unit: () => "%", decimals: 1, control: "size",
    content: (f, clock, choices) => specs.coverage(f, clock.effort, choices) },
  { title: "Entropy of the map", unit: () => "nat", decimals: 0,
    content: (f, clock) => specs.entropy(f, clock.effort) },
  { title: "Density", unit: () => "points a voxel", decimals: 1,
    content: (f, clock) => specs.density(f, clock.effort) },
  { title: "Utility of the chosen views", decimals: "significant", control: "term",
    note: "The first view is chosen by nobody: it has no utility",
    unit: specs.termUnit,
    content: (f, clock, choices) => specs.terms(f, clock.effort, choices) },
];

/** What the controls of a plot have chosen, for its title where they are not there: ", 0.05 m". */
export function chosenWords(kind: PlotKind, flights: Flight[],
    { size, term, bands }: specs.PlotChoices, hasSeeds: boolean): string {
  const seeds = bands && hasSeeds ? ", mean and range of seeds" : "";
  if (kind.control === "size") {
    return (flights.length > 1 ? `, ${specs.kSizes[size]}` : "") + seeds;
  }
  if (kind.control !== "term" || term === "utility") return seeds;
  return `: ${specs.termOptions(flights).find(([key]) => key === term)?.[1].toLowerCase()}${seeds}`;
}

/** A value beside its line's name; an en dash where there is none. */
export function valueText({ decimals }: PlotKind, v: number | null | undefined): string {
  if (v === null || v === undefined) return "–";
  if (decimals === "significant") return significant(v);
  return v.toLocaleString("en-US", Math.abs(v) >= 1000 ? { maximumFractionDigits: 0 }
    : { maximumFractionDigits: decimals, minimumFractionDigits: decimals });
}

/** Of a run at an effort at which another one has a view: its latest value. */
export function lastValue(values: ArrayLike<number | null | undefined>,
    at: number | null): number | null {
  for (let i = at ?? -1; i >= 0; --i) {
    const value = values[i];
    if (value !== null && value !== undefined) return value;
  }
  return null;
}

/** Room above and below, and for the paper's rings; never below zero when nothing is. */
export function yRange(low: number, high: number, rings: specs.Ring[]): [number, number] {
  const values = [low, high, ...rings.map((ring) => ring.y)].filter(Number.isFinite);
  if (values.length === 0) return [0, 1];
  const [least, most] = [Math.min(...values), Math.max(...values)];
  const room = 0.06 * (most - least || Math.abs(most) || 1);
  return [least >= 0 && least - room < 0 ? 0 : least - room, most + room];
}
