// How fast a page of gnbv report is in a Chromium without a graphics card: size, first picture, 20
// steps of the slider; wall time and, of all of the browser's processes, processor time, which tells
// more on a busy machine.
// usage: node page_speed.mjs CHROMIUM PAGE
import { readFileSync, readdirSync, statSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser } from "./browser.mjs";

const [chromium, page] = process.argv.slice(2);

/** Of all processes below this one, in seconds. */
function processorTime() {
  const all = new Map();
  for (const name of readdirSync("/proc").filter((entry) => /^\d+$/.test(entry))) {
    try {
      const text = readFileSync(`/proc/${name}/stat`, "utf8");
      const fields = text.slice(text.lastIndexOf(")") + 2).split(" ");
      all.set(Number(name), { parent: Number(fields[1]),
        seconds: (Number(fields[11]) + Number(fields[12])) / 100 });
    } catch { /* it has ended */ }
  }
  const isOurs = (id) => id === process.pid || (all.has(id) && isOurs(all.get(id).parent));
  return [...all].filter(([id]) => id !== process.pid && isOurs(id))
    .reduce((sum, [, { seconds }]) => sum + seconds, 0);
}

const browser = await Browser.open(chromium, 1440, 900);
const drawn = () => browser.evaluate(
  "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
async function timed(what, work) {
  const [wall, processor] = [performance.now(), processorTime()];
  await work();
  console.log(`${what}: ${((performance.now() - wall) / 1000).toFixed(2)} s, processor `
    + `${(processorTime() - processor).toFixed(2)} s`);
}

try {
  console.log(`${(statSync(page).size / 1e6).toFixed(2)} MB`);
  await timed("first picture", async () => {
    await browser.call("Page.navigate", { url: pathToFileURL(resolve(page)).href });
    await browser.until("!!window.gnbv");
    await drawn();
  });
  await browser.until("gnbv.stage.detail.drawnSoFar.whole > 0");
  const slider = "document.querySelector('.transport input[type=range]')";
  const last = Number(await browser.evaluate(`${slider}.max`));
  const before = await browser.evaluate("gnbv.stage.detail.drawnSoFar");
  await timed("20 steps of the slider", async () => {
    for (let i = 1; i <= 20; ++i) {
      await browser.evaluate(`${slider}.value = ${Math.round(i * last / 20)};
        ${slider}.dispatchEvent(new Event("input", { bubbles: true }))`);
      await drawn();
    }
  });
  const after = await browser.evaluate("gnbv.stage.detail.drawnSoFar");
  console.log(`pictures meanwhile: ${after.gist - before.gist} of the gist, `
    + `${after.whole - before.whole} whole`);
} finally {
  await browser.close();
}
