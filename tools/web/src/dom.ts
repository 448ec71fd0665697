// Elements by function call. Text is always set as text: no name in a report is ever markup.

export type Child = Node | string | null;
type Properties = Record<string, string | number | boolean | ((event: Event) => void)>;

export function make<K extends keyof HTMLElementTagNameMap>(
    tag: K, properties: Properties = {}, ...children: Child[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (typeof value === "function") element.addEventListener(key, value);
    else if (key === "class") element.className = String(value);
    else if (typeof value === "boolean") element.toggleAttribute(key, value);
    else element.setAttribute(key, String(value));
  }
  for (const child of children) if (child !== null) element.append(child);
  return element;
}

/** A label ("chip") or a mark ("dot") in the colour of a run, by its number on the page. */
export function ofRun(kind: "chip" | "dot", run: number, ...children: Child[]): HTMLElement {
  const element = make("span", { class: kind }, ...children);
  element.style.setProperty("--run", `var(--run-${run})`);
  return element;
}

/** A bar of colours with what its ends and its middle stand for under it, and their unit. */
export function colourBar(colours: string, what: string, [low, middle, high]: string[],
    unit: string): HTMLElement {
  const bar = make("i", { class: "mark bar" });
  bar.style.backgroundImage = colours;
  return make("span", {}, what, make("span", { class: "scale" }, bar,
    make("span", { class: "scale-ends" }, ...[low, middle, high].flatMap((at) =>
      [make("b", {}, at), " "]))), ` ${unit}`);
}

/** Buttons of which one is pressed; press() tells which one where it was not a click. */
export function choice<T extends string>(label: string, options: [T, string][],
    choose: (value: T) => void): { element: HTMLElement; press: (value: T) => void } {
  const buttons = options.map(([value, text]) =>
    make("button", { type: "button", click: () => { press(value); choose(value); } }, text));
  const press = (chosen: T) => buttons.forEach((button, i) =>
    button.setAttribute("aria-pressed", String(options[i][0] === chosen)));
  return { element: make("div", { class: "choice", role: "group", "aria-label": label },
    ...buttons), press };
}

export function select<T extends string>(
    label: string, options: [T, string][], chosen: T, choose: (value: T) => void): HTMLElement {
  const element = make("select", { "aria-label": label },
    ...options.map(([value, text]) => make("option", { value, selected: value === chosen }, text)));
  element.addEventListener("change", () => choose(element.value as T));
  return element;
}

export function toggle(text: string, on: boolean, change: (on: boolean) => void): HTMLElement {
  const box = make("input", { type: "checkbox", checked: on });
  box.addEventListener("change", () => change(box.checked));
  return make("label", { class: "toggle" }, box, text);
}

/** "1,234.5" */
export function number(value: number, decimals = 0): string {
  return value.toLocaleString("en-US",
    { minimumFractionDigits: decimals, maximumFractionDigits: decimals });
}

/** "28.1", as the tables have it. */
export const minutes = (seconds: number) => number(seconds / 60, 1);

/** "34.7 m", which no line breaks. */
export const measure = (value: string, unit: string) => (unit === "" ? value
  : `${value}\u00a0${unit}`);

/** Three digits that count, scientific below 0.001: "0.0123", "4.56e-5". */
export function significant(value: number): string {
  if (value !== 0 && Math.abs(value) < 1e-3) return value.toExponential(2);
  return value.toLocaleString("en-US",
    { minimumSignificantDigits: 3, maximumSignificantDigits: 3 });
}
