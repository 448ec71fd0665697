// Elements by function call. Text is always set as text: no name in a report is ever markup.

export type Child = Node | string | null;
type Properties = Record<string, string | number | boolean | ((event: Event) => void)>;

export function make<K extends keyof HTMLElementTagNameMap>(
    tag: K, properties: Properties = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (typeof value === "function") element.addEventListener(key, value);
    else if (typeof value === "boolean") element.toggleAttribute(key, value);
    else element.setAttribute(key, String(value));
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** A label ("chip") or a mark ("dot") in the colour of a run, by its number on the page. */
export function ofRun(kind: "chip" | "dot", run: number, ...children: Child[]): HTMLElement {
  const element = make("span", { class: kind }, ...children);
  element.style.setProperty("--run", `var(--run-${run})`);
  return element;
}

/** A dot, a line or a bar of what the page names; `colour` may be a gradient. */
export function mark(shape: "dot" | "line" | "bar", colour: string): HTMLElement {
  const element = make("i", { class: `mark ${shape}` });
  element.style.background = colour;
  return element;
}

/** A bar of colours with what its ends and its middle stand for under it, and their unit. */
export const colourBar = (colours: string, what: string, ends: string[], unit: string) =>
  make("span", {}, what, make("span", { class: "scale" }, mark("bar", colours),
    make("span", { class: "scale-ends" }, ...ends.flatMap((at) => [make("b", {}, at), " "]))),
  ` ${unit}`);

export function select<T extends string>(
    label: string, options: [T, string][], chosen: T, choose: (value: T) => void): HTMLElement {
  const element = make("select",
    { "aria-label": label, change: () => choose(element.value as T) },
    ...options.map(([value, text]) => make("option", { value, selected: value === chosen }, text)));
  return element;
}

export function toggle(text: string, on: boolean, change: (on: boolean) => void, name = "") {
  const box = make("input",
    { type: "checkbox", name, checked: on, change: () => change(box.checked) });
  return make("label", { class: "toggle" }, box, text);
}

/** "1,234.5" */
export const number = (value: number, decimals = 0) => value.toLocaleString("en-US",
  { minimumFractionDigits: decimals, maximumFractionDigits: decimals });

/** "34.7 m", which no line breaks. */
export const measure = (value: string, unit: string) => (unit === "" ? value
  : `${value}\u00a0${unit}`);

/** Three digits that count, scientific below 0.001: "0.0123", "4.56e-5". */
export const significant = (value: number) => (value !== 0 && Math.abs(value) < 1e-3
  ? value.toExponential(2) : value.toLocaleString("en-US",
    { minimumSignificantDigits: 3, maximumSignificantDigits: 3 }));

export function saveFile(blob: Blob | null, name: string) {
  if (!blob) return;
  const url = URL.createObjectURL(blob);
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** For file names: "a_b" of "A: b". */
export const fileName = (title: string) =>
  title.toLowerCase().replace(/[^a-z0-9]+/g, "_").replace(/^_|_$/g, "") || "gnbv";
