// The page of gnbv report where it is shown otherwise: from a link, on paper, in a narrow window, before
// the first view; and what its scales, marks and titles say.
// usage: node page_look_test.mjs CHROMIUM PAGE RUN...
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser } from "./browser.mjs";

const [chromium, page, ...runs] = process.argv.slice(2);
const url = pathToFileURL(resolve(page)).href;
const isAlone = runs.length === 1;

const browser = await Browser.open(chromium, 1200, 800);
const drawn = () => browser.evaluate(
  "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
const open = async (hash = "") => {
  await browser.call("Page.navigate", { url: "about:blank" });
  await browser.call("Page.navigate", { url: url + hash });
  await browser.until("!!window.gnbv");
};
const seek = async (n) => { await browser.evaluate(`gnbv.seek(${n})`); await drawn(); };
const textsOf = (selector) => browser.evaluate(
  `[...document.querySelectorAll(${JSON.stringify(selector)})].map((e) => e.textContent)`);
const visible = (selector) => browser.evaluate(
  `[...document.querySelectorAll(${JSON.stringify(selector)})].filter((e) => e.checkVisibility()).length`);
const resize = (width, height) => browser.call("Emulation.setDeviceMetricsOverride",
  { width, height, deviceScaleFactor: 1, mobile: false });
const click = (text) => browser.evaluate(`[...document.querySelectorAll("button")]
  .find((button) => button.textContent === "${text}").click()`);
/** What the program wrote into the page of each run. */
const data = () => browser.evaluate("JSON.parse(document.getElementById('data').textContent).runs");

try {
  // a link that measures by something else presses that button, and the plots have that axis
  for (const [by, name] of [["metres", "Metres"], ["seconds", "Seconds"], ["views", "Views"]]) {
    await open(`#by=${by}&at=1`);
    assert.deepEqual(await textsOf(".choice [aria-pressed=true]"), [name]);
  }

  // who prints at once, before the browser asks for any picture, has one; then one of paper's shape
  const { identifier } = await browser.call("Page.addScriptToEvaluateOnNewDocument",
    { source: "window.requestAnimationFrame = () => 0;" });
  await open();
  assert.equal((await browser.evaluate("gnbv.pictures()")).gist, 1);
  const [ratio, pixels, colours] = await browser.evaluate(`(() => {
    dispatchEvent(new Event("beforeprint"));
    const canvas = document.querySelector(".stage canvas");
    const stage = document.querySelector(".stage.printed");
    const context = new OffscreenCanvas(100, 60).getContext("2d");
    context.drawImage(canvas, 0, 0, 100, 60);
    const { data } = context.getImageData(0, 0, 100, 60);
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4) seen.add(data.slice(i, i + 3).join());
    return [canvas.width / canvas.height * stage.clientHeight / stage.clientWidth, canvas.width,
      seen.size];
  })()`);
  assert.ok(Math.abs(ratio - 1) < 0.02 && pixels > 1300, `${ratio}, ${pixels} px`);
  assert.ok(colours > 50, `${colours} colours`);
  assert.equal((await browser.evaluate("gnbv.pictures()")).whole, 1);
  await browser.evaluate("dispatchEvent(new Event('afterprint'))");
  assert.equal(await visible(".stage.printed"), 0);
  await browser.call("Page.removeScriptToEvaluateOnNewDocument", { identifier });

  // on paper plots are vectors, nothing is there to tick, and what was chosen stands in the title
  await open();
  await drawn();
  await resize(703, 1032);
  await browser.call("Emulation.setEmulatedMedia", { media: "print" });
  await drawn();
  assert.ok(await visible(".plot svg") >= 3);
  assert.equal(await visible(".plot canvas, input, select"), 0);
  assert.equal(await browser.evaluate(`[...document.querySelectorAll(
    ".plot:first-child :is(.plot-title, .plot-choice)")].filter((e) => e.checkVisibility())
    .map((e) => e.textContent).join("")`), isAlone ? "Coverage" : "Coverage, 0.05 m");
  // pictures and what was missed leave no part of their row empty
  const widths = await browser.evaluate(`[".strip", ".missed-list", ".board"].map((of) =>
    document.querySelector(of).getBoundingClientRect().width)`);
  const frames = await visible(".strip .frame");
  if (widths[1] > 0) {
    const across = frames > 2 ? widths[0] : widths[0] + widths[1];
    assert.ok(across > 0.95 * widths[2], `${widths}`);
  }
  await browser.call("Emulation.setEmulatedMedia", { media: "screen" });

  // a narrow window: two rows of figures, none cut; buttons stay together; two runs lie one above
  // the other
  await resize(700, 900);
  await drawn();
  const topsOf = (selector) => browser.evaluate(`[...new Set([...document.querySelectorAll(
    "${selector}")].map((e) => Math.round(e.getBoundingClientRect().top)))].length`);
  const tiles = await browser.evaluate(
    "[...document.querySelectorAll('.tile')].map((e) => e.getBoundingClientRect().top)");
  assert.equal(tiles.filter((top) => top === tiles[0]).length, Math.ceil(tiles.length / 2));
  assert.equal(await browser.evaluate(
    "[...document.querySelectorAll('.tile')].filter((e) => e.scrollWidth > e.clientWidth).length"), 0);
  assert.equal(await topsOf(".tools button"), 1);
  assert.equal(await topsOf(".pane"), runs.length);
  await resize(1200, 800);

  // before the first view: the picture that comes is called so, the profile leads to the vehicle
  await open("#at=0");
  await drawn();
  const captions = await textsOf(".frame figcaption");
  assert.ok(captions.length > 0 && captions.every((text) => text.includes("next: view 1")),
    `${captions}`);
  assert.match((await textsOf(".legend"))[0], /profile flight/);
  for (const [i, { profile_end_s }] of (await data()).entries()) {
    const flown = readFileSync(join(runs[i], "trajectory.tum"), "utf8").trim().split("\n").slice(1)
      .map((line) => line.split(" ").map(Number));
    const end = flown.findLast(([time]) => time <= profile_end_s + 1e-3);
    const pose = await browser.evaluate(`gnbv.pose(${i})`);
    assert.ok(Math.hypot(...[1, 2, 3].map((k) => end[k] - pose[k - 1])) < 0.1, `${pose}, ${end}`);
  }

  // the last view is not on the edge of a plot
  await open();
  await drawn();
  assert.ok(await browser.evaluate(`[...document.querySelectorAll(".u-over")].every((over) =>
    over.getBoundingClientRect().right - over.querySelector(".now").getBoundingClientRect().right
      > 0.01 * over.clientWidth)`));
  assert.match(await browser.evaluate("document.querySelector('.plot:last-child .plot-title').title"),
    /first view is chosen by nobody/);
  // a run has its dashes in every plot: equal ones are both seen
  const dashed = await browser.evaluate(`[...document.querySelectorAll(".plot svg")].map((svg) =>
    svg.querySelectorAll("path[stroke-dasharray]").length)`);
  if (!isAlone) assert.deepEqual(new Set(dashed), new Set([runs.length - 1]));
  if (isAlone) assert.deepEqual(new Set(dashed), new Set([0]));

  // points of a view are named where there are any
  const [first] = await data();
  const brought = await browser.evaluate(`(() => {
    const bytes = Uint8Array.from(atob(document.getElementById("run-0").textContent),
      (c) => c.charCodeAt(0));
    const [at, count] = ${JSON.stringify(first.cloud.after)};
    return [...new Uint32Array(bytes.buffer, at, count)];
  })()`);
  for (let n = 0; n < brought.length && isAlone; ++n) {
    await seek(n);
    assert.equal((await textsOf(".legend"))[0].includes("points of this view"),
      brought[n] > (brought[n - 1] ?? Infinity), `view ${n}`);
  }

  // the colours of errors end at 1, 2 or 5 times a power of ten, the least that holds 95 %
  for (const [i, run] of (await data()).entries()) {
    if (!run.cloud.error) continue;
    const [scale, errors] = await browser.evaluate(`(() => {
      const bytes = Uint8Array.from(atob(document.getElementById("run-${i}").textContent),
        (c) => c.charCodeAt(0));
      const [at, count] = ${JSON.stringify(run.cloud.error)};
      return [gnbv.errors(${i}), [...bytes.slice(at, at + count)]];
    })()`);
    const known = errors.filter((error) => error !== 255).sort((a, b) => a - b);
    const within = (mm) => known.filter((error) => error <= mm).length / known.length;
    const round = [1, 2, 5, 10, 20, 50, 100, 200, 500];
    assert.equal(scale.most_mm, round.find((mm) => within(mm) >= 0.95));
    assert.ok(within(scale.median_mm) >= 0.5 && within(scale.median_mm - 1) <= 0.5);
  }

  // rays of the chosen view end within the camera's range; reasons are explained; numbers have three
  // digits that count
  await open("#layers=cloud,candidates");
  const { views, cameras } = first;
  const range_m = Math.max(...cameras.map((camera) => camera.range_m));
  for (let n = 1; n <= views.x.length; ++n) {
    await seek(n);
    const ends = await browser.evaluate("gnbv.rays(0)");
    for (let i = 0; i < ends.length; i += 3) {
      const away = Math.hypot(ends[i] - views.x[n - 1], ends[i + 1] - views.y[n - 1],
        ends[i + 2] - views.z[n - 1]);
      assert.ok(away < range_m + 1, `${away} m from view ${n}`);
    }
    for (const value of await textsOf(".why td.number")) {
      assert.match(value, /^-?(0\.00|\d\.\d\de-\d+|0\.0{0,2}\d{3}|[\d,]+|\d{1,2}\.\d{1,2})$/, value);
    }
    const unexplained = await browser.evaluate(`[...document.querySelectorAll(".why p span")]
      .filter((reason) => reason.title.length < 20).map((reason) => reason.textContent)`);
    assert.deepEqual(unexplained, []);
  }

  // "Fit" has what the layers show in the picture: it goes farther back for what lies farther out
  const distance = async (layers) => {
    await open(`#layers=${layers}&at=2`);
    await drawn();
    await click("Fit");
    const [x, y, z] = await browser.evaluate("gnbv.camera()");
    return Math.hypot(x, y, z);
  };
  const near = await distance("structure");
  assert.ok(await distance("structure,profile") > near);

  // a place is said with its axes and the sign of minus
  await browser.until("document.querySelectorAll('.regions li').length > 0");
  for (const region of await textsOf(".regions li")) {
    assert.match(region, /around x\s\u2212?[\d.]+, y\s\u2212?[\d.]+, z\s\u2212?[\d.]+\sm$/);
  }
} finally {
  await browser.close();
}
