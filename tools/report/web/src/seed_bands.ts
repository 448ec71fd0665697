// Several seeds of one configuration as their mean within their range.
import type uPlot from "uplot";
import type { Effort } from "./clock";
import { runColour } from "./colours";
import type { Flight } from "./flight";
import type { Line, PlotContent } from "./plot_specs";

/** Equal for runs that differ by their seed alone, as far as the page knows. */
const configuration = ({ data }: Flight) =>
  JSON.stringify([data.structure, data.utility, data.preset,
    data.yaml.replace(/^seed:.*$/m, "")]);

function groupsOf(flights: Flight[]): Flight[][] {
  const groups = new Map<string, Flight[]>();
  for (const flight of flights) {
    const key = configuration(flight);
    groups.set(key, [...groups.get(key) ?? [], flight]);
  }
  return [...groups.values()];
}

/** Whether there is anything to draw a band of. */
export const haveSeeds = (flights: Flight[]) => groupsOf(flights).some((group) => group.length > 1);

/** The latest value of each effort; nothing before the first and after the run's end. */
function carried(xs: ArrayLike<number>, ys: ArrayLike<number | null | undefined>,
    end: number): (number | null)[] {
  let latest: number | null = null;
  return Array.from({ length: xs.length }, (_, i) => {
    latest = ys[i] ?? latest;
    return xs[i] <= end + 1e-9 ? latest : null;
  });
}

/** `content` of a line a run; as far as all seeds of a configuration go. */
export function withBands(content: PlotContent, flights: Flight[], effort: Effort): PlotContent {
  const xs = content.data[0];
  const lines: Line[] = [];
  const columns: (number | null | undefined)[][] = [];
  const bands: NonNullable<PlotContent["bands"]> = [];
  for (const group of groupsOf(flights)) {
    const members = group.flatMap((flight) => {
      const line = content.lines.findIndex((each) => each.run === flight.index);
      return line < 0 ? []
        : [carried(xs, content.data[line + 1], flight.last(effort))];
    });
    const [first] = group;
    const line = content.lines.find((each) => each.run === first.index);
    if (!line) continue;
    if (members.length < 2) {
      lines.push(line);
      columns.push([...content.data[content.lines.indexOf(line) + 1]]);
      continue;
    }
    const over = (of: (values: number[]) => number) => Array.from({ length: xs.length }, (_, i) => {
      const values = members.map((member) => member[i]);
      return values.every((value) => value !== null) ? of(values as number[]) : null;
    });
    const name = line.name.replace(/,? seed \d+/, "");
    const colour = runColour(first.index);
    lines.push({ name: `${name}: mean of ${members.length} seeds`, colour, width: 2 },
      { name: "least", colour, width: 0 }, { name: "most", colour, width: 0 });
    columns.push(over((v) => v.reduce((a, b) => a + b, 0) / v.length),
      over((v) => Math.min(...v)), over((v) => Math.max(...v)));
    bands.push({ high: lines.length, low: lines.length - 1, fill: `${colour}38` });
  }
  content.lines.forEach((line, i) => { // of no run
    if (line.run !== undefined) return;
    lines.push(line);
    columns.push([...content.data[i + 1]]);
  });
  return { ...content, lines, bands, data: [xs, ...columns] as uPlot.AlignedData };
}
