// A headless Chromium, driven over a pipe by its DevTools protocol: no package, no port.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const kFlags = ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
  "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--no-first-run",
  "--disable-background-networking", "--remote-debugging-pipe"];

export class Browser {
  #process;
  #profile = mkdtempSync(join(tmpdir(), "gnbv-page-"));
  #waiting = new Map();
  #listeners = [];
  #next = 1;
  #session;
  #hasEnded = false;

  /** Opens a window of that size on an empty page. */
  static async open(chromium, width, height) {
    const browser = new Browser();
    browser.#start(chromium, width, height);
    const { targetId } = await browser.#call("Target.createTarget",
      { url: "about:blank" });
    const { sessionId } = await browser.#call("Target.attachToTarget", { targetId, flatten: true });
    browser.#session = sessionId;
    for (const domain of ["Page", "Runtime", "Log", "Network"]) {
      await browser.call(`${domain}.enable`);
    }
    await browser.call("Emulation.setEmulatedMedia",
      { features: [{ name: "prefers-color-scheme", value: "light" }] });
    await browser.call("Emulation.setDeviceMetricsOverride",
      { width, height, deviceScaleFactor: 1, mobile: width < 600 });
    return browser;
  }

  /** A command to the page; what it answers. */
  call(method, parameters = {}) { return this.#call(method, parameters, this.#session); }

  /** Every event of the page. */
  listen(listener) { this.#listeners.push(listener); }

  /** A PNG of a part of the page, in base64. */
  async picture({ x, y, width, height }) {
    const { data } = await this.call("Page.captureScreenshot",
      { format: "png", clip: { x, y, width, height, scale: 1 } });
    return data;
  }

  /** The value of a JavaScript expression in the page; promises are awaited. */
  async evaluate(expression) {
    const { result, exceptionDetails } = await this.call("Runtime.evaluate",
      { expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description}`);
    return result.value;
  }

  /** Waits until the expression is true. */
  async until(expression, seconds = 120) {
    const end = Date.now() + 1000 * seconds;
    while (!await this.evaluate(expression)) {
      if (Date.now() > end) throw new Error(`not within ${seconds} s: ${expression}`);
      await new Promise((done) => setTimeout(done, 50));
    }
  }

  async close() {
    if (!this.#hasEnded) {
      const ended = new Promise((done) => { this.#process.once("exit", done); });
      this.#call("Browser.close").catch(() => {});
      await ended;
    }
    rmSync(this.#profile, { recursive: true, force: true, maxRetries: 5 });
  }

  #start(chromium, width, height) {
    this.#process = spawn(chromium,
      [...kFlags, `--window-size=${width},${height}`, `--user-data-dir=${this.#profile}`],
      { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    let text = "";
    this.#process.stdio[4].setEncoding("utf8"); // a character may come in two chunks
    this.#process.stdio[4].on("data", (chunk) => {
      const messages = (text + chunk).split("\0");
      text = messages.pop();
      for (const message of messages) this.#receive(JSON.parse(message));
    });
    this.#process.once("exit", (code, signal) => this.#end(`Chromium ended: ${code ?? signal}`));
    this.#process.once("error", (error) => this.#end(`Chromium does not start: ${error.message}`));
    // a pipe without anybody at its end; "exit" tells the rest
    for (const pipe of this.#process.stdio.slice(3)) pipe.on("error", () => {});
  }

  #end(why) {
    this.#hasEnded = true;
    for (const { reject } of this.#waiting.values()) reject(new Error(why));
    this.#waiting.clear();
  }

  #receive(message) {
    const waiting = this.#waiting.get(message.id);
    if (!waiting) {
      for (const listener of this.#listeners) listener(message.method, message.params);
      return;
    }
    this.#waiting.delete(message.id);
    if (message.error) waiting.reject(new Error(message.error.message));
    else waiting.resolve(message.result);
  }

  #call(method, params = {}, sessionId = undefined) {
    if (this.#hasEnded) return Promise.reject(new Error(`${method}: Chromium has ended`));
    const id = this.#next++;
    this.#process.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }
}
