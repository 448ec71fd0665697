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

/** Colours from `low` to `high`, with what their middle stands for between the halves. */
export function colourBar(colours: string, low: string, middle: string, high: string): HTMLElement {
  const half = (side: string) => {
    const swatch = make("i", { class: `mark bar half ${side}` });
    swatch.style.backgroundImage = colours;
    return swatch;
  };
  return make("span", {}, low, half("low"), middle, half("high"), high);
}

/** Buttons of which one is pressed. */
export function choice<T extends string>(
    label: string, options: [T, string][], chosen: T, choose: (value: T) => void): HTMLElement {
  const buttons = options.map(([value, text]) =>
    make("button", { type: "button", "aria-pressed": String(value === chosen), click: () => {
      buttons.forEach((b, i) => b.setAttribute("aria-pressed", String(options[i][0] === value)));
      choose(value);
    } }, text));
  return make("div", { class: "choice", role: "group", "aria-label": label }, ...buttons);
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
