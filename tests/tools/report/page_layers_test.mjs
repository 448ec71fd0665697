// The page of gnbv report as a browser meets it: what was missed, why this view, links, keys, files
// and paper. Its replay: page_test.mjs.
// usage: node page_layers_test.mjs CHROMIUM PAGE RUN...
import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser } from "./browser.mjs";

const [chromium, page, ...runs] = process.argv.slice(2);
const url = pathToFileURL(resolve(page)).href;

/** Coverage at 0.05 m after the profile and after each view. */
function coverage(run) {
  const [head, ...rows] = readFileSync(join(run, "coverage.csv"), "utf8").trim().split("\n");
  const column = head.split(",").findIndex((name) => name === "coverage_0.05");
  assert.ok(column >= 0, head);
  return rows.map((row) => Number(row.split(",")[column]));
}

/** x, y, z of each view. */
function recorded(run) {
  const [head, ...rows] = readFileSync(join(run, "iterations.csv"), "utf8").trim().split("\n");
  return rows.map((row) => ["x", "y", "z"].map((name) =>
    Number(row.split(",")[head.split(",").indexOf(name)])));
}

/** Whether all fly one configuration with different seeds. */
const areSeeds = () => new Set(runs.map((run) =>
  readFileSync(join(run, "scenario.yaml"), "utf8").replace(/^seed:.*$/m, ""))).size === 1;

/** A reason of rejection as pictures and pages name it. */
const words = (reason) => ({ recently_visited: "visited", cluster_outside_fov: "cluster outside view",
  no_fly: "no-fly box", beyond_gimbal: "beyond the gimbal" })[reason] ?? reason.replaceAll("_", " ");

/** Of the decision that chose each view. */
function candidates(run, views) {
  const lines = readFileSync(join(run, "candidates.jsonl"), "utf8").trim();
  const all = lines === "" ? [] : lines.split("\n").map((line) => JSON.parse(line));
  return Array.from({ length: views }, (_, view) => all.filter((c) => c.iteration === view));
}

/** Of the decision that chose each view: how many voxels of each kind, and where the first is. */
function believed(run, views) {
  const yaml = readFileSync(join(run, "scenario.yaml"), "utf8");
  const [, min, max] = yaml.match(/workspace_m:\n +min: (\[.*\])\n +max: (\[.*\])/).map((text) =>
    text.startsWith("[") ? JSON.parse(text) : null);
  const voxel_m = Number(yaml.match(/resolution_m: (.*)/)[1]);
  const low = min.map((x) => Math.floor(x / voxel_m + 1e-6));
  const size = max.map((x, k) => Math.ceil(x / voxel_m - 1e-6) - low[k]);
  const all = Array.from({ length: views }, () => ({}));
  for (const line of readFileSync(join(run, "beliefs.jsonl"), "utf8").trim().split("\n")) {
    const { iteration, ...lists } = JSON.parse(line);
    for (const [kind, runs] of Object.entries(lists)) {
      const [first] = runs;
      all[iteration][kind] = { count: runs.reduce((sum, x, i) => sum + (i % 2) * x, 0),
        first: [first % size[0] + low[0], Math.floor(first / size[0]) % size[1] + low[1],
          Math.floor(first / (size[0] * size[1])) + low[2]] };
    }
  }
  return all;
}

const browser = await Browser.open(chromium, 900, 700);
const complaints = [];
browser.listen((event, parameters) => {
  if (event === "Runtime.exceptionThrown") complaints.push(JSON.stringify(parameters));
  if (event === "Log.entryAdded" && parameters.entry.level === "error") {
    complaints.push(parameters.entry.text);
  }
});
const drawn = () => browser.evaluate(
  "new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => done(true))))");
const seek = async (n) => { await browser.evaluate(`gnbv.seek(${n})`); await drawn(); };
const box = (name) => `[...document.querySelectorAll(".layers label")]
  .find((label) => label.textContent === "${name}").querySelector("input")`;
const flip = async (name) => { await browser.evaluate(`${box(name)}.click()`); await drawn(); };
const canvas = "document.querySelector('.stage canvas')";
const press = async (key, element) => {
  await browser.evaluate(`${element}.focus()`);
  const text = key.length === 1 ? { text: key } : {};
  await browser.call("Input.dispatchKeyEvent", { type: "keyDown", key, ...text });
  await browser.call("Input.dispatchKeyEvent", { type: "keyUp", key });
  await drawn();
};
const pyramids = [];
const camera = () => browser.evaluate("gnbv.camera()");
const open = async (hash = "") => {
  await browser.call("Page.navigate", { url: "about:blank" });
  await browser.call("Page.navigate", { url: url + hash });
  await browser.until("!!window.gnbv");
  await drawn();
};

/** The 3D view as mean colours of cells of 8 x 8 pixels. */
async function coarseStage() {
  const { width, height, ...place } = await browser.evaluate(`(() => {
    const { x, y, width, height } = ${canvas}.getBoundingClientRect();
    return { x: x + scrollX, y: y + scrollY, width, height };
  })()`);
  const png = await browser.picture({ ...place, width, height });
  return browser.evaluate(`(async () => {
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

try {
  await browser.call("Page.setDownloadBehavior", { behavior: "deny" });
  // the gist, which machines without a graphics card draw while things move, looks like the whole,
  // be its points drawn by the renderer or, where that seems slow, by the page
  for (const clockRate of [0, 1e6]) {
    const { identifier } = await browser.call("Page.addScriptToEvaluateOnNewDocument", { source: `
      const later = setTimeout.bind(window), now = performance.now.bind(performance);
      window.held = [];
      window.setTimeout = (call, ms, ...rest) =>
        ms >= 600 && window.held ? window.held.push(call) : later(call, ms, ...rest);
      performance.now = () => ${clockRate} * now();` });
    for (const layers of ["cloud,structure,path", "found,missed,structure"]) {
      await open(`#layers=${layers}`);
      const gist = await coarseStage();
      assert.equal((await browser.evaluate("gnbv.pictures()")).whole, 0);
      await browser.evaluate("[held.splice(0), held = null][0].forEach((call) => call())");
      await browser.until("gnbv.pictures().whole > 0");
      const whole = await coarseStage();
      const background = whole[0];
      const away = (a, b) => Math.max(...a.map((x, i) => Math.abs(x - b[i])));
      const drawn = whole.filter((cell) => away(cell, background) > 24).length;
      const other = whole.filter((cell, i) => away(cell, gist[i]) > 48).length;
      const where = `${layers}, clock x ${clockRate}`;
      assert.ok(drawn > 0.01 * whole.length, `${drawn} cells of ${whole.length}: ${where}`);
      assert.ok(other < 0.1 * drawn, `${other} of ${drawn} cells differ: ${where}`);
    }
    await browser.call("Page.removeScriptToEvaluateOnNewDocument", { identifier });
  }
  await open();

  // found is what coverage.csv says, at every view and on the way back
  const curves = runs.map(coverage);
  await flip("Missed");
  await flip("Found");
  for (const n of [...curves[0].keys(), 1]) {
    await seek(n);
    for (const [run, curve] of curves.entries()) {
      const { found, missed, onlyOther } = await browser.evaluate(`gnbv.found(${run})`);
      const share = found / (found + missed + onlyOther);
      assert.ok(Math.abs(share - curve[n]) < 1e-6, `view ${n}: ${share}, not ${curve[n]}`);
      assert.ok(runs.length > 1 || onlyOther === 0);
    }
  }
  if (runs.length > 1) { // what neither found is the same for both
    const [a, b] = await browser.evaluate("[gnbv.found(0), gnbv.found(1)]");
    assert.equal(a.missed, b.missed);
    assert.equal(a.found + a.onlyOther, b.found + b.onlyOther);
  }
  const regions = "document.querySelectorAll('.regions button')";
  const before = await camera();
  await browser.until(`${regions}.length > 0`);
  await browser.evaluate(`${regions}[0].click()`);
  await drawn();
  assert.notDeepEqual(await camera(), before, "a missed region is looked at");

  // each decision with all its candidates, and what became of them
  await flip("Candidates");
  for (let n = 1; n < curves[0].length; ++n) {
    await seek(n);
    for (const [run, folder] of runs.entries()) {
      const recorded = candidates(folder, curves[run].length - 1)[n - 1];
      assert.equal(await browser.evaluate(`gnbv.candidates(${run})`), recorded.length, `view ${n}`);
      const reasons = new Set(recorded.filter((c) => c.rejected).map((c) => c.rejected));
      const told = await browser.evaluate("document.querySelector('.why').textContent");
      for (const reason of reasons) assert.ok(told.includes(words(reason)), told);
    }
  }

  // and the voxels for whose sake it was made, each where the map has it
  const offered = await browser.evaluate(
    "[...document.querySelectorAll('.layers label')].map((label) => label.textContent)");
  const hasFrontiers = runs.some((run) =>
    readFileSync(join(run, "beliefs.jsonl"), "utf8").includes("frontier"));
  assert.equal(offered.includes("Frontiers"), hasFrontiers);
  const layers = ["Unknown", ...hasFrontiers ? ["Frontiers"] : []];
  for (const layer of layers) await press(" ", box(layer));
  let believedVoxels = 0;
  for (let n = 1; n < curves[0].length; ++n) {
    await seek(n);
    for (const [run, folder] of runs.entries()) {
      const recorded = believed(folder, curves[run].length - 1)[n - 1];
      for (const kind of ["unknown", "frontier", "looked_at"]) {
        const drawn = await browser.evaluate(`gnbv.believed(${run}, "${kind}")`);
        assert.equal(drawn.length, recorded[kind]?.count ?? 0, `view ${n}: ${kind}`);
        assert.deepEqual(drawn[0], recorded[kind]?.first, `view ${n}: ${kind}`);
        believedVoxels += drawn.length;
      }
      if (runs.length > 1) continue;
      const told = await browser.evaluate("document.querySelector('.legend').textContent");
      const count = (recorded.unknown?.count ?? 0).toLocaleString("en-US");
      assert.ok(told.includes(`rays were to cross: ${count}`), told);
    }
  }
  assert.ok(believedVoxels > 50, `${believedVoxels}`);
  for (const layer of layers) await press(" ", box(layer));

  // the pyramid of a view stands where the view is
  for (const [run, folder] of runs.entries()) {
    recorded(folder).forEach((place, view) => pyramids.push([run, view, place]));
  }
  for (const [run, view, place] of pyramids) {
    const ends = await browser.evaluate(`gnbv.frustum(${run}, ${view})`);
    assert.ok(ends.length > 0);
    for (let i = 0; i < ends.length; i += 3) {
      const away = Math.hypot(...place.map((x, k) => ends[i + k] - x));
      assert.ok(away < 2, `a corner ${away} m from view ${view + 1}`);
    }
  }

  // the line of the surface has the truth to its left alone and the surface to its right alone
  if (existsSync(join(runs[0], "surface")) && runs.length === 1) {
    await open("#layers=structure");
    await browser.until("gnbv.pictures().whole > 0");
    const alone = await coarseStage();
    await open("#layers=structure,surface,cloud");
    const at = async (share) => {
      const { whole } = await browser.evaluate("gnbv.pictures()");
      await browser.evaluate(`(() => {
        const line = document.querySelector(".swipe input");
        line.value = ${share};
        line.dispatchEvent(new Event("input", { bubbles: true }));
      })()`);
      await browser.until(`gnbv.pictures().whole > ${whole}`);
      return coarseStage();
    };
    const [surface, half, truth] = [await at(0), await at(0.5), await at(1)];
    const columns = await browser.evaluate(`Math.floor(${canvas}.clientWidth / 8)`);
    const differ = (a, b, isAsked) => a.filter((cell, i) => i > 9 * columns // below the labels
      && isAsked(i % columns / columns)
      && Math.max(...cell.map((x, k) => Math.abs(x - b[i][k]))) > 24).length;
    const isLeft = (x) => x < 0.47;
    const isRight = (x) => x > 0.53;
    assert.equal(differ(truth, alone, () => true), 0);
    assert.equal(differ(half, truth, isLeft), 0);
    assert.equal(differ(half, surface, isRight), 0);
    assert.ok(differ(half, surface, isLeft) > 5 && differ(half, truth, isRight) > 5);
  }

  // a view tells what it saw, in place, and a point the views that had it in sight
  const [, , [x, y, z]] = pyramids[0];
  await open(`#at=${curves[0].length - 1}&runs=0&layers=frusta&camera=${x},${y - 1},${z},${x},${y},${z}`);
  await press("Enter", canvas);
  assert.match(await browser.evaluate("document.querySelector('.picked').textContent"),
    /^View \d+, at/);
  assert.ok(await browser.evaluate("document.querySelectorAll('.picked img').length") > 0);
  const { tried, sawIt } = await browser.evaluate(`(() => {
    const all = Array.from({ length: 100000 }, (_, i) => i).map((i) => gnbv.point(0, 7 * i))
      .filter((point) => point && point[3] >= 0);
    const sawIt = all.filter((p) => gnbv.seenBy(0, p.slice(0, 3)).includes(p[3])).length;
    return { tried: all.length, sawIt };
  })()`);
  assert.ok(tried > 3 && sawIt >= 0.85 * tried, `${sawIt} of ${tried}`);
  await open();
  await flip("Missed");

  // of several runs, bars of frontier views lie beside the curves: nobody takes them for one
  const lanes = await browser.evaluate(`[...document.querySelectorAll(".phase-lane")].map((lane) =>
    [lane.getBoundingClientRect().bottom, lane.closest(".u-over").getBoundingClientRect().top,
      lane.children.length])`);
  const atFrontiers = runs.filter((run) =>
    readFileSync(join(run, "iterations.csv"), "utf8").includes(",fvs,"));
  assert.equal(lanes.length, runs.length > 1 ? atFrontiers.length : 0);
  for (const [bottom, top, bars] of lanes) assert.ok(bottom <= top && bars > 0, `${lanes}`);

  // what colours stand for is named in the middle, too
  for (const ends of await browser.evaluate(`[...document.querySelectorAll(".scale-ends")]
    .map((under) => [...under.children].map((end) => end.textContent))`)) {
    assert.ok(ends.length === 3 && ends.every((end) => end !== ""), `${ends}`);
  }

  // seeds of one configuration are drawn as their mean, where there are any
  const seeds = "document.querySelector(\"select[aria-label='Runs of several seeds']\")";
  const isBand = runs.length > 1 && areSeeds();
  assert.equal(await browser.evaluate(`!!${seeds}`), isBand);
  if (isBand) {
    await browser.evaluate(`${seeds}.value = "bands";
      ${seeds}.dispatchEvent(new Event("change", { bubbles: true }))`);
    const ends = curves.map((curve) => 100 * curve.at(-1));
    const mean = ends.reduce((a, b) => a + b, 0) / ends.length;
    await seek(curves[0].length - 1);
    const told = await browser.evaluate("document.querySelector('.u-legend').textContent");
    for (const value of [mean, Math.min(...ends), Math.max(...ends)]) {
      assert.ok(told.includes(value.toFixed(1)), `${value} in ${told}`);
    }
  }

  // keys turn, zoom and fit the 3D view, and tell what is in its middle
  for (const key of ["a", "w", "+", "l", "i"]) {
    const from = await camera();
    await press(key, canvas);
    assert.notDeepEqual(await camera(), from, key);
  }
  await browser.evaluate(`${regions}[0].click()`);
  await seek(curves[0].length - 1);
  if (runs.length === 1) {
    await press("Enter", canvas);
    assert.match(await browser.evaluate("document.querySelector('.picked').textContent"),
      /^A (voxel|point)/);
  }

  // a link shows what its sender saw
  await seek(2);
  await press("d", canvas);
  await browser.until("location.hash.includes('at=2') && location.hash.includes('missed')");
  await new Promise((done) => setTimeout(done, 600));
  const [seen, hash] = [await camera(), await browser.evaluate("location.hash")];
  await browser.call("Page.navigate", { url: "about:blank" });
  await browser.call("Page.navigate", { url: url + hash });
  await browser.until("!!window.gnbv");
  await drawn();
  assert.equal(await browser.evaluate("gnbv.views(0)"), 2);
  assert.equal(await browser.evaluate(`${box("Missed")}.checked`), true);
  (await camera()).forEach((x, i) => assert.ok(Math.abs(x - seen[i]) < 2e-3, `${x}, ${seen[i]}`));
  // and one that was tampered with is no worse than none
  await browser.call("Page.navigate", { url: "about:blank" });
  await browser.call("Page.navigate", { url: `${url}#at=x&camera=1,2&runs=99&layers=<svg>&by=no` });
  await browser.until("!!window.gnbv");

  // pictures as files
  const saved = (button) => browser.evaluate(`new Promise((done) => {
    const make = URL.createObjectURL;
    URL.createObjectURL = (blob) => {
      URL.createObjectURL = make;
      blob.text().then((text) => done([blob.type, blob.size, text.slice(0, 100000)]));
      return make.call(URL, blob);
    };
    [...document.querySelectorAll("button")].find((b) => b.textContent === "${button}").click();
  })`);
  const [pngType, pngSize] = await saved("Save PNG");
  assert.equal(pngType, "image/png");
  assert.ok(pngSize > 5000, `${pngSize}`);
  const [, , svg] = await saved("SVG");
  assert.deepEqual(await browser.evaluate(`(() => {
    const svg = new DOMParser().parseFromString(${JSON.stringify(svg)}, "image/svg+xml");
    return [svg.querySelectorAll("parsererror, script").length,
      svg.querySelectorAll("path[stroke-width]").length > 0,
      [...svg.querySelectorAll("text")].filter((t) => t.textContent === "FVS").length,
      svg.querySelectorAll("rect").length > document.querySelectorAll(".phase-lane i").length];
  })()`), [0, true, Math.min(1, lanes.length), true]);

  // everything that can be used can be reached by Tab, has a name and is large enough for a finger
  const poor = await browser.evaluate(`[...document.querySelectorAll(
      "button, select, summary, input, canvas[tabindex], .toggle")]
    .filter((e) => e.checkVisibility()).flatMap((e) => {
      const { width, height } = (e.closest("label") ?? e).getBoundingClientRect();
      const name = e.ariaLabel || e.textContent || e.closest("label")?.textContent;
      const isSmall = width < 24 || height < 24;
      return !name || isSmall || (e.tabIndex < 0 && !e.matches(".toggle"))
        ? [e.outerHTML.slice(0, 80) + " " + width + "x" + height] : [];
    })`);
  assert.deepEqual(poor, []);

  // paper: an A4 page is 186 mm between its margins, and nothing reaches beyond
  await browser.call("Emulation.setEmulatedMedia", { media: "print" });
  await browser.call("Emulation.setDeviceMetricsOverride",
    { width: 703, height: 1032, deviceScaleFactor: 1, mobile: false });
  await drawn();
  assert.ok(await browser.evaluate("document.documentElement.scrollWidth") <= 703);
  assert.equal(await browser.evaluate(
    "[...document.querySelectorAll('button:not(.picture), select')].filter((e) => e.checkVisibility()).length"), 0);
  // a phone: nothing reaches beyond its width, the layers stand in three columns
  await browser.call("Emulation.setEmulatedMedia", { media: "screen" });
  await browser.call("Emulation.setDeviceMetricsOverride",
    { width: 390, height: 844, deviceScaleFactor: 1, mobile: true });
  await drawn();
  assert.ok(await browser.evaluate("document.documentElement.scrollWidth") <= 390);
  const columns = await browser.evaluate(`[...document.querySelectorAll(".layers .toggle")]
    .map((e) => Math.round(e.getBoundingClientRect().left))`);
  assert.equal(new Set(columns).size, 3, columns.join(" "));
  assert.deepEqual(complaints, []);
  assert.equal(await browser.evaluate("window.hacked"), undefined);
} finally {
  await browser.close();
}
