// What the plots show, as numbers: a column of efforts and a column a line.
import uPlot from "uplot";
import type { Effort } from "./clock";
import { faintLine, lineColour, paleInk, runColour } from "./colours";
import type { Flight } from "./flight";

export interface Line {
  name: string;
  colour: string;
  width: number;
  dash?: number[];
  steps?: boolean; // a value stays until the next
  run?: number; // whose it is, with several
}

/** A point of the paper, drawn as a ring. */
export interface Ring {
  x: number;
  y: number;
  colour: string;
  label: string; // of the paper's row
}

export interface PlotContent {
  lines: Line[];
  data: uPlot.AlignedData;
  rings: Ring[];
  beginsBefore: boolean; // of the first view: with a value after the profile alone
  bands?: { high: number; low: number; fill: string }[]; // between lines, counted from 1
}

export interface PlotChoices {
  size: 0 | 1 | 2; // of coverage, with several runs
  term: Term | "all";
  bands: boolean; // of several seeds their mean and range
}

export type Term = "utility" | "information" | "density_term" | "prediction" | "distance_factor";
export const kTerms: [Term, string][] = [["distance_factor", "Distance factor"],
  ["density_term", "Density term"], ["information", "Information"], ["prediction", "Prediction"],
  ["utility", "Utility"]]; // the last is drawn on top
/** One for several runs; of one run those that it has, or all of them beside each other. */
export function termOptions(flights: Flight[]): [Term | "all", string][] {
  if (flights.length !== 1) return kTerms;
  return [...usedTerms(flights[0]).reverse(), ["all", "All terms"]];
}
export const kSizes = ["0.05 m", "0.10 m", "0.50 m"];

type Column = [efforts: number[], values: number[]];

/** Columns of different efforts on one axis. */
function joined(columns: Column[]): uPlot.AlignedData {
  if (columns.length === 0) return [[]];
  const sameEffort = columns.every(([x]) => x === columns[0][0]);
  if (sameEffort) return [columns[0][0], ...columns.map(([, y]) => y)];
  return uPlot.join(columns.map(([x, y]) => [x, y] as uPlot.AlignedData));
}

const efforts = (flight: Flight, effort: Effort, from: 0 | 1) =>
  Array.from({ length: flight.count + 1 - from }, (_, i) => flight.effort(i + from, effort));

/** Of values that begin after the first view, or with the profile alone where they are longer. */
const column = (flight: Flight, effort: Effort, values: number[]): Column =>
  [efforts(flight, effort, values.length > flight.count ? 0 : 1), values];

const ringOf = (flight: Flight, effort: Effort, y: number | undefined): Ring[] => {
  const paper = flight.data.paper;
  const x = paper?.[effort];
  if (!paper || x === undefined || y === undefined) return [];
  return [{ x, y, colour: runColour(flight.index), label: paper.label }];
};

/** What could be reached at a voxel size, each once. */
function ceilings(flights: Flight[], size: number, colour: string) {
  const shares = new Set(flights.flatMap(({ data }) => data.ceiling?.[size] ?? []));
  return [...shares].map((share) => ({ share: 100 * share,
    line: { name: `ceiling, ${kSizes[size]}`, colour, width: 1.2, dash: [5, 4] } }));
}

export function coverage(flights: Flight[], effort: Effort, { size }: PlotChoices): PlotContent {
  const scored = flights.filter((flight) => flight.data.figures);
  const percent = (flight: Flight, k: number) =>
    flight.data.figures!.curve.coverage.map((c) => 100 * c[k]);
  if (flights.length === 1) {
    const [flight] = scored;
    if (!flight) return { lines: [], data: [[]], rings: [], beginsBefore: true };
    const x = efforts(flight, effort, 0);
    const ceiling = ceilings(scored, 0, lineColour(0));
    return {
      lines: [...kSizes.map((name, k) => ({ name, colour: lineColour(k), width: 2, steps: true })),
        ...ceiling.map(({ line }) => line)],
      data: joined([...kSizes.map((_, k): Column => [x, percent(flight, k)]),
        ...ceiling.map(({ share }): Column => [x, x.map(() => share)])]),
      rings: kSizes.flatMap((_, k) =>
        ringOf(flight, effort, flight.data.paper?.coverage_percent?.[k])
          .map((ring) => ({ ...ring, colour: lineColour(k) }))),
      beginsBefore: true,
    };
  }
  const ceiling = ceilings(scored, size, paleInk());
  const longest = scored.reduce((a, b) => (b.last(effort) > a.last(effort) ? b : a), scored[0]);
  return {
    lines: [...scored.map((flight) =>
      ({ name: flight.data.label, colour: runColour(flight.index), width: 2, steps: true,
        run: flight.index })), ...ceiling.map(({ line }) => line)],
    data: joined([...scored.map((flight): Column =>
      [efforts(flight, effort, 0), percent(flight, size)]),
    ...ceiling.map(({ share }): Column => {
      const x = efforts(longest, effort, 0);
      return [x, x.map(() => share)];
    })]),
    rings: scored.flatMap((flight) =>
      ringOf(flight, effort, flight.data.paper?.coverage_percent?.[size])),
    beginsBefore: true,
  };
}

function perRun(flights: Flight[], effort: Effort, values: (flight: Flight) => number[],
    name: string, width = 2): PlotContent {
  return {
    lines: flights.map((flight) => ({ name: flights.length > 1 ? flight.data.label : name,
      colour: runColour(flight.index), width, run: flight.index })),
    data: joined(flights.map((flight) => column(flight, effort, values(flight)))),
    rings: [],
    beginsBefore: flights.some((flight) => values(flight).length > flight.count),
  };
}

/** Total entropy of the map; after the profile alone, too, where the run was scored. */
export function entropy(flights: Flight[], effort: Effort): PlotContent {
  return perRun(flights, effort, ({ data, count }) => {
    if (!data.figures || count === 0) return data.views.entropy;
    const last = data.views.entropy[count - 1];
    return [last + data.figures.entropy_reduction, ...data.views.entropy];
  }, "Entropy");
}

export function density(flights: Flight[], effort: Effort): PlotContent {
  const content = perRun(flights, effort, ({ data }) => data.views.density, "Points per voxel");
  content.rings = flights.flatMap((flight) => ringOf(flight, effort, flight.data.paper?.density));
  return content;
}

/**
 * Terms have different units, and so have utilities of different formulas: several in one plot are
 * shares of their largest.
 */
const isShare = (flights: Flight[], term: PlotChoices["term"]) => (flights.length === 1
  ? term === "all" : new Set(flights.map((flight) => flight.data.utility)).size > 1);

export function termUnit(flights: Flight[], { term }: PlotChoices): string {
  if (!isShare(flights, term)) return "";
  return `share of each ${flights.length === 1 ? "term" : "run"}'s largest`;
}

const largest = (values: (number | null)[]) =>
  Math.max(...values.map((value) => Math.abs(value ?? 0))) || 1;

/** Those that have a say in what the run chose. */
const usedTerms = (flight: Flight) => kTerms.filter(([key]) => {
  const rest = key === "distance_factor" ? 1 : 0;
  return key === "utility" || flight.data.views[key].some((value) => value !== rest);
});

/** Of one run's chosen views a term, or all, each a share of its largest; or one term of several. */
export function terms(flights: Flight[], effort: Effort, { term }: PlotChoices): PlotContent {
  // a start, or a move that was not chosen among candidates, has no score
  const scores = (flight: Flight, key: Term) => flight.data.views[key].map((value, i) =>
    (flight.data.views.candidates[i] > 0 ? value : null));
  const shares = (flight: Flight, key: Term) => {
    const values = scores(flight, key);
    const most = isShare(flights, term) ? largest(values) : 1;
    return values.map((value) => (value === null ? null : value / most) as number);
  };
  if (term !== "all" || flights.length !== 1) {
    const one = term === "all" ? "utility" : term;
    const name = kTerms.find(([key]) => key === one)![1];
    return perRun(flights, effort, (f) => shares(f, one), name, 1.6);
  }
  const used = usedTerms(flights[0]);
  const x = efforts(flights[0], effort, 1);
  return {
    lines: used.map(([key, name], i) => ({ name, width: 1.2,
      colour: key === "distance_factor" ? faintLine() : lineColour(i - 1) })),
    data: joined(used.map(([key]) => [x, shares(flights[0], key)])),
    rings: [],
    beginsBefore: false,
  };
}

// None for the first, since a run alone is solid.
const kDashes: (number[] | undefined)[] = [undefined, [7, 6], [2, 4], [10, 4, 2, 4]];

/** A run's lines have its dashes in every plot: where they lie on another's, both are seen. */
export function withDashes(content: PlotContent): PlotContent {
  const runs = [...new Set(content.lines.map(({ run }) => run).filter((run) => run !== undefined))];
  const lines = content.lines.map((line) => (line.run === undefined ? line
    : { ...line, dash: line.dash ?? kDashes[runs.indexOf(line.run) % kDashes.length] }));
  return { ...content, lines };
}

/** Spans of effort in which frontier view sampling chose the views. */
export function frontierPhases(flight: Flight, effort: Effort): [number, number][] {
  const spans: [number, number][] = [];
  flight.data.views.sampler.forEach((sampler, view) => {
    if (sampler !== "fvs") return;
    const [from, to] = [flight.effort(view, effort), flight.effort(view + 1, effort)];
    const open = spans.at(-1);
    if (open && open[1] === from) open[1] = to; else spans.push([from, to]);
  });
  return spans;
}
