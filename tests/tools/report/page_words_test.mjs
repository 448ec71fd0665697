// The page of gnbv report says what it draws: its legend, its counts, its values before the first
// view, and itself on paper.
// usage: node page_words_test.mjs CHROMIUM PAGE RUN...
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser } from "./browser.mjs";

const [chromium, page, ...runs] = process.argv.slice(2);
const url = pathToFileURL(resolve(page)).href;

/** Lines of a run's file of candidates. */
function candidates(run) {
  const lines = readFileSync(join(run, "candidates.jsonl"), "utf8").trim();
  return lines === "" ? [] : lines.split("\n").map((line) => JSON.parse(line));
}

const browser = await Browser.open(chromium, 900, 700);
const drawn = () => browser.evaluate(
  "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
const open = async (hash = "") => {
  await browser.call("Page.navigate", { url: "about:blank" });
  await browser.call("Page.navigate", { url: url + hash });
  await browser.until("!!window.gnbv");
  await drawn();
};
const seek = async (n) => { await browser.evaluate(`gnbv.seek(${n})`); await drawn(); };
const textOf = (selector) =>
  browser.evaluate(`document.querySelector(${JSON.stringify(selector)}).textContent`);
/** The values beside the names of a plot's lines. */
const valuesOf = (title) => browser.evaluate(`[...document.querySelectorAll(".plot")]
  .find((plot) => plot.querySelector(".plot-title").textContent === "${title}")
  .querySelectorAll(".u-series:not(:first-child) .u-value").values().map((e) => e.textContent)
  .toArray()`);

try {
  // voxels have no camera colours, and the legend does not say so
  await open("#layers=cloud,voxels&colour=real");
  assert.match(await textOf(".legend"), /points: camera colours/);
  assert.match(await textOf(".legend"), /voxels: height/);
  await open("#layers=cloud,voxels&colour=density");
  assert.match(await textOf(".legend"), /points, voxels: density.* or more points/);

  // nor does it list points where the surface hides them
  if (existsSync(join(runs[0], "surface")) && runs.length === 1) {
    await open("#layers=cloud,structure,surface");
    assert.doesNotMatch(await textOf(".legend"), /points:/);
  }

  // what another run found is told apart where there is one
  await open("#layers=missed");
  assert.equal(/found by the other run/.test(await textOf(".legend")), runs.length > 1);

  // the counts of a decision add up
  await open("#layers=candidates");
  const views = await browser.evaluate("gnbv.views(0)");
  for (let n = 1; n <= views && runs.length === 1; ++n) {
    await seek(n);
    const recorded = candidates(runs[0]).filter((c) => c.iteration === n - 1);
    if (recorded.length === 0) continue;
    const counts = [...(await textOf(".legend")).matchAll(/: ([\d,]+)/g)]
      .map(([, count]) => Number(count.replace(",", "")));
    assert.equal(counts.reduce((a, b) => a + b, 0), recorded.length, `view ${n}`);
    const valid = recorded.filter((c) => !c.rejected).length;
    // of the sampler that chose it, in the very words of the replay, which add up to all
    const told = (await textOf(".readout")).match(/[\d,]+ of [\d,]+ \w+ candidates valid/)[0];
    const why = await textOf(".why");
    assert.ok(why.includes(told), `${n}: ${why}`);
    const pairs = [...why.matchAll(/([\d,]+) of ([\d,]+)/g)].map((found) =>
      found.slice(1).map((count) => Number(count.replaceAll(",", ""))));
    const sum = (k) => pairs.reduce((all, pair) => all + pair[k], 0);
    assert.deepEqual([sum(0), sum(1)], [valid, recorded.length], `${n}: ${why}`);
  }

  // before the first view there is a coverage, the profile's, and no density
  await open();
  await seek(0);
  assert.ok((await valuesOf("Coverage")).every((value) => value !== "–"));
  assert.ok((await valuesOf("Density")).every((value) => value === "–"));
  const ofViews = /path, views: first|points of this view|what the cameras see/;
  assert.doesNotMatch(await textOf(".legend"), ofViews);
  await seek(1);
  assert.match(await textOf(".legend"), ofViews);
  assert.ok((await valuesOf("Density")).every((value) => value !== "–"));

  // of the terms of one run each is 1 at its largest
  if (runs.length === 1) {
    await browser.evaluate(`(() => {
      const term = document.querySelector("select[aria-label='Term of the utility']");
      term.value = "all";
      term.dispatchEvent(new Event("change", { bubbles: true }));
    })()`);
  }
  const largest = [];
  for (let n = 1; n <= views && runs.length === 1; ++n) {
    await seek(n);
    for (const [i, value] of (await valuesOf("Utility of the chosen views")).entries()) {
      largest[i] = Math.max(largest[i] ?? 0, Math.abs(Number(value)) || 0);
    }
  }
  for (const value of largest) assert.ok(value === 0 || value === 1, `${largest}`);

  // on paper the 3D view keeps its shape, though a page that is printed is not told of its new size
  await browser.call("Page.addScriptToEvaluateOnNewDocument", { source: `
    const Observer = window.ResizeObserver;
    window.ResizeObserver = class extends Observer {
      constructor(call) { super((...all) => { if (!window.isPrinted) call(...all); }); }
    };` });
  await open();
  await browser.evaluate("window.isPrinted = true");
  await browser.call("Emulation.setEmulatedMedia", { media: "print" });
  await browser.call("Emulation.setDeviceMetricsOverride",
    { width: 703, height: 1032, deviceScaleFactor: 1, mobile: false });
  await drawn();
  const [pixels, shown] = await browser.evaluate(`(() => {
    const { width, height, clientWidth, clientHeight } = document.querySelector(".stage canvas");
    return [width / height, clientWidth / clientHeight];
  })()`);
  assert.ok(Math.abs(shown / pixels - 1) < 0.02, `${shown}, not ${pixels}`);

  // and the lanes of frontier views, of which a legend tells, are there, over the curves
  const told = await browser.evaluate(
    "document.querySelectorAll('.marks-key .swatch.strip').length");
  const lanes = await browser.evaluate(`[...document.querySelectorAll(".plot svg text")]
    .filter((text) => text.textContent === "FVS" && text.checkVisibility()).length`);
  assert.equal(lanes > 0, told > 0);
} finally {
  await browser.close();
}
