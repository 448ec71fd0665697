// A page of gnbv report in a browser, and what its tests ask of both.
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser } from "./browser.mjs";

/** The rows of a run's CSV file, as objects of text. */
export function csv(run, name) {
  const [head, ...rows] = readFileSync(join(run, name), "utf8").trim().split("\n")
    .map((line) => line.split(","));
  return rows.map((row) => Object.fromEntries(head.map((key, i) => [key, row[i]])));
}

/** x, y, z, yaw of each view. */
export const viewsOf = (run) => csv(run, "iterations.csv")
  .map((row) => ["x", "y", "z", "yaw"].map((key) => Number(row[key])));

/** The objects of a run's file of one JSON object a line. */
export function jsonLines(run, name) {
  const text = readFileSync(join(run, name), "utf8").trim();
  return text === "" ? [] : text.split("\n").map((line) => JSON.parse(line));
}

export class Page {
  complaints = [];
  requests = [];

  static async open(chromium, file, width, height) {
    const page = new Page();
    page.url = pathToFileURL(resolve(file)).href;
    page.browser = await Browser.open(chromium, width, height);
    page.browser.listen((event, parameters) => {
      if (event === "Runtime.exceptionThrown") page.complaints.push(JSON.stringify(parameters));
      if (event === "Runtime.consoleAPICalled" && parameters.type === "error") {
        page.complaints.push(JSON.stringify(parameters.args));
      }
      if (event === "Log.entryAdded" && parameters.entry.level === "error") {
        page.complaints.push(parameters.entry.text);
      }
      if (event === "Network.requestWillBeSent") page.requests.push(parameters.request.url);
    });
    return page;
  }

  is(expression) { return this.browser.evaluate(expression); }
  until(expression) { return this.browser.until(expression); }
  close() { return this.browser.close(); }

  /** Anew, as a link with that hash has it. */
  async go(hash = "") {
    await this.browser.call("Page.navigate", { url: "about:blank" });
    await this.browser.call("Page.navigate", { url: this.url + hash });
    await this.until("!!window.gnbv");
    await this.drawn();
  }

  /** Two frames later. */
  drawn() {
    return this.is(
      "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
  }

  async seek(views) {
    await this.is(`gnbv.seek(${views})`);
    await this.drawn();
  }

  textOf(selector) {
    return this.is(`[...document.querySelectorAll(${JSON.stringify(selector)})]
      .map((e) => e.textContent).join("\\n")`);
  }

  visible(selector) {
    return this.is(`[...document.querySelectorAll(${JSON.stringify(selector)})]
      .filter((e) => e.checkVisibility()).length`);
  }

  /** Sets a slider, or chooses of a list. */
  async set(selector, value) {
    await this.is(`(() => {
      const element = document.querySelector(${JSON.stringify(selector)});
      element.value = ${JSON.stringify(value)};
      for (const kind of ["input", "change"]) {
        element.dispatchEvent(new Event(kind, { bubbles: true }));
      }
    })()`);
    await this.drawn();
  }

  async click(text) {
    await this.is(`[...document.querySelectorAll("button, label")]
      .find((each) => each.textContent === ${JSON.stringify(text)}).click()`);
    await this.drawn();
  }

  /** Pressed and released where the element has the focus. */
  async press(key, selector) {
    if (selector) await this.is(`document.querySelector(${JSON.stringify(selector)}).focus()`);
    const more = key === " " ? { code: "Space", text: " ", windowsVirtualKeyCode: 32 }
      : { code: key, ...key.length === 1 ? { text: key } : {} };
    await this.browser.call("Input.dispatchKeyEvent", { type: "keyDown", key, ...more });
    await this.browser.call("Input.dispatchKeyEvent", { type: "keyUp", key, ...more });
    await this.drawn();
  }

  /** The window, and whether it is paper. */
  async shape(width, height, media = "screen", features = []) {
    await this.browser.call("Emulation.setEmulatedMedia", { media, features });
    await this.browser.call("Emulation.setDeviceMetricsOverride",
      { width, height, deviceScaleFactor: 1, mobile: width < 600 });
    await this.drawn();
  }

  /** The 3D view as mean colours of cells of 8 x 8 pixels. */
  async cells() {
    const clip = await this.is(`(() => {
      const canvas = document.querySelector(".stage canvas");
      canvas.scrollIntoView({ block: "center" });
      const { x, y, width, height } = canvas.getBoundingClientRect();
      return { x: x + scrollX, y: y + scrollY, width, height };
    })()`);
    const png = await this.browser.picture(clip);
    return this.is(`(async () => {
      const image = new Image();
      image.src = "data:image/png;base64,${png}";
      await image.decode();
      const [columns, rows] = [Math.floor(image.width / 8), Math.floor(image.height / 8)];
      const context = new OffscreenCanvas(columns, rows).getContext("2d");
      context.imageSmoothingQuality = "high";
      context.drawImage(image, 0, 0, columns, rows);
      const { data } = context.getImageData(0, 0, columns, rows);
      return Array.from({ length: columns * rows }, (_, i) => [...data.slice(4 * i, 4 * i + 3)]);
    })()`);
  }
}

/** How many cells of two pictures are clearly of other colours; of one, than its corner. */
export const different = (a, b = null, least = 24) => a.filter((cell, i) =>
  Math.max(...cell.map((x, k) => Math.abs(x - (b ? b[i][k] : a[0][k])))) > least).length;
