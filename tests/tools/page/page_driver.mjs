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

/** What tests ask the page's own objects, of a run by its number, at the replay's place. */
const kQuestions = `Object.assign(gnbv, {
  seek: (views) => gnbv.clock.seek(views),
  views: (run) => gnbv.scenes[run].flight.n,
  points: (run) => gnbv.scenes[run].model.densities.count.reduce((a, b) => a + b, 0),
  rays: (run) => gnbv.scenes[run].candidates.rayEnds.flatMap((end) => end.toArray()),
  found: (run) => { // of the true surface
    const { surface } = gnbv.scenes[run];
    const { found: after, now } = surface;
    const found = after.filter((n) => n <= now).length;
    const onlyOther = [...after.keys()]
      .filter((i) => after[i] > now && surface.isFoundByOther(i)).length;
    return { found, onlyOther, missed: after.length - found - onlyOther };
  },
  candidates: (run) => gnbv.scenes[run].candidates.now.length,
  believed: (run, kind) => gnbv.scenes[run].believed.cells(kind).size,
  frustum: (run, view) => { // ends of its lines
    const { object, perView } = gnbv.scenes[run].frusta;
    return [...object.geometry.getAttribute("position").array
      .slice(3 * view * perView, 3 * (view + 1) * perView)];
  },
  point: (run, i) => { // and the view that brought it
    const { points, cloudAfter } = gnbv.scenes[run].model;
    return 3 * i >= points.length ? null
      : [...points.subarray(3 * i, 3 * i + 3), cloudAfter.filter((end) => end <= i).length - 1];
  },
  seenBy: (run, [x, y, z]) => {
    const place = gnbv.scenes[run].vehicle.position.clone().set(x, y, z);
    return gnbv.viewsThatSaw(place, gnbv.scenes[run]);
  },
  plan: (run) => gnbv.scenes[run].plan?.places.length ?? 0,
  camera: () => gnbv.stage.camera.position.toArray(),
  pose: (run) => { // x, y, z, yaw of the vehicle as it is drawn
    const { position: p, quaternion: q } = gnbv.scenes[run].vehicle;
    return [p.x, p.y, p.z, 2 * Math.atan2(q.z, q.w)];
  },
})`;

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
    await this.is(`${kQuestions}, true`);
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
