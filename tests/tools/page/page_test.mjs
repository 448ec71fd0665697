// A report in a browser: it loads without a complaint and without a request, the slider, the keys
// and the plots move the vehicle to the recorded views, and no name is ever run.
// usage: node page_test.mjs CHROMIUM PAGE RUN...
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { join } from "node:path";
import { Page, csv, different, viewsOf } from "./page_driver.mjs";

const [chromium, file, ...runs] = process.argv.slice(2);
const views = runs.map(viewsOf);
const last = views[0].length;
const page = await Page.open(chromium, file, 800, 500);
const slider = ".transport input[type=range]";

async function assertAt(run, view, what) {
  const pose = await page.is(`gnbv.pose(${run})`);
  const turn = Math.abs(pose[3] - view[3]) % (2 * Math.PI);
  // the page computes in double precision, and stores no pose of a view in less
  for (let i = 0; i < 3; ++i) assert.ok(Math.abs(pose[i] - view[i]) < 1e-9, `${what}: ${pose}`);
  assert.ok(Math.min(turn, 2 * Math.PI - turn) < 1e-9, `${what}: ${pose}, not ${view}`);
}

try {
  await page.go();
  // the slider moves every vehicle to its recorded view, so do a key and a click into a plot
  for (let n = 1; n <= last; ++n) {
    await page.set(slider, n);
    for (const [run, all] of views.entries()) {
      await assertAt(run, all[Math.min(n, all.length) - 1], `view ${n}`);
    }
  }
  await page.press("ArrowLeft");
  await assertAt(0, views[0].at(-2), "after the left arrow");
  const [x, y] = await page.is(`(() => {
    const plot = document.querySelector(".plot-place");
    plot.scrollIntoView({ block: "center" });
    const { left, top, width, height } = plot.getBoundingClientRect();
    return [left + 60 + 0.4 * (width - 76), top + height / 2];
  })()`);
  for (const type of ["mousePressed", "mouseReleased"]) {
    await page.browser.call("Input.dispatchMouseEvent",
      { type, x, y, button: "left", clickCount: 1 });
  }
  await page.drawn();
  const clicked = Number(await page.is(`document.querySelector("${slider}").value`));
  const longest = Math.max(...views.map((all) => all.length));
  assert.equal(clicked, Math.round(0.4 * 1.02 * longest));
  await assertAt(0, views[0][clicked - 1], "after a click into a plot");

  // before the first view there is a moment of its own, however the mission is measured
  for (const effort of ["Metres", "Seconds", "Views"]) {
    await page.click(effort);
    await page.press("Home", slider);
    assert.equal(await page.is("gnbv.views(0)"), 0, effort);
    await page.press("ArrowRight", slider);
    assert.equal(await page.is("gnbv.views(0)"), 1, effort);
    await assertAt(0, views[0][0], `the first view in ${effort}`);
  }

  // space belongs to the box that has the focus
  const box = "document.querySelector('.layers input').checked";
  const wasOn = await page.is(box);
  await page.press(" ", ".layers input");
  assert.equal(await page.is(box), !wasOn);
  assert.equal(await page.is("document.querySelector('.play').ariaLabel"), "Play");
  await page.press(" ", ".layers input");

  // playing goes on by itself, rests at a view, and ends where the mission ends
  await page.seek(1);
  // in the page itself: a busy machine would let it play to its end before we could ask
  await page.is(`new Promise((done) => {
    const play = document.querySelector(".play");
    const look = () => {
      if (Number(document.querySelector("${slider}").value) < 2) {
        requestAnimationFrame(look);
        return;
      }
      play.click();
      done(true);
    };
    play.click();
    requestAnimationFrame(look);
  })`);
  await page.drawn();
  const rest = Number(await page.is(`document.querySelector("${slider}").value`));
  assert.ok(Number.isInteger(rest) && rest < last, `rests at ${rest}`);
  await assertAt(0, views[0][rest - 1], "after a pause");
  await page.set(".transport select", "4");
  await page.is("document.querySelector('.play').click()");
  await page.until("document.querySelector('.play').ariaLabel === 'Play'");
  await page.drawn();
  await assertAt(0, views[0].at(-1), "when all was played");

  // what is drawn stands out from the background, and changes with the replay
  const pictureAfter = async (n) => {
    await page.seek(n);
    return page.cells();
  };
  const [first, end] = [await pictureAfter(1), await pictureAfter(last)];
  assert.ok(different(first) > 0.02 * first.length, "the 3D view is empty");
  assert.ok(different(end, first) > 0.005 * first.length, "the 3D view does not change");

  // of a tour what it still meant to do, and only where its layer is chosen
  const hasTour = await page.is("gnbv.data.runs.some((run) => run.plan)");
  assert.equal((await page.textOf(".layers label")).split("\n").includes("Plan"), hasTour);
  if (hasTour) {
    const run = runs.findIndex((folder) => existsSync(join(folder, "plan.jsonl")));
    for (let n = 1; n <= last; ++n) {
      await page.seek(n);
      const k = 2 * Math.min(n, views[run].length);
      const [begin, end] = await page.is(
        `[...gnbv.data.runs[${run}].plan.ranges.subarray(${k - 2}, ${k})]`);
      assert.equal(await page.is(`gnbv.plan(${run})`), end - begin, `plan at view ${n}`);
    }
    const withPlan = await pictureAfter(2);
    await page.click("Plan");
    assert.ok(different(await pictureAfter(2), withPlan, 6) > 2, "the plan stays");
    await page.click("Plan");
  }

  // voxels are as dense as they were at the view, on the way back, too
  await page.set("select[aria-label='Colour of points and voxels']", "density");
  for (const n of [1, last, 2]) {
    await page.seek(n);
    for (const [run, folder] of runs.entries()) {
      const rows = csv(folder, "iterations.csv");
      const points = Number(rows[Math.min(n, rows.length) - 1].cloud_points);
      assert.equal(await page.is(`gnbv.points(${run})`), points, `points at view ${n}`);
    }
  }

  // at night the page is dark, all of it
  const day = await pictureAfter(2);
  await page.shape(800, 500, "screen", [{ name: "prefers-color-scheme", value: "dark" }]);
  assert.ok(different(await pictureAfter(2), day) > 0.5 * day.length, "the 3D view stays bright");
  await page.shape(800, 500, "screen", [{ name: "prefers-color-scheme", value: "light" }]);

  assert.equal(await page.is("window.hacked"), undefined);
  assert.deepEqual(await page.is(`document.querySelectorAll(
    "svg:not(.plot-place > svg, .axes > svg), svg[onload], svg [onload], #app script").length`), 0);
  assert.ok(await page.is("document.body.textContent.includes('<svg onload')"),
    "the hostile name is to be read as text");
  assert.deepEqual(page.complaints, []);
  const isOurs = (request) => request === page.url || /^(blob|data|about):/.test(request);
  assert.deepEqual(page.requests.filter((request) => !isOurs(request)), []);

  // the policy, not good manners, keeps the network out, and foreign scripts
  assert.equal(await page.is(
    "fetch('https://example.invalid/').then(() => 'sent', () => 'refused')"), "refused");
  assert.ok(page.complaints.some((text) => text.includes("Content Security Policy")));
  await page.is(`document.body.append(Object.assign(document.createElement("script"),
    { textContent: "window.hacked = 1" }))`);
  assert.equal(await page.is("window.hacked"), undefined);

  // without WebGL the rest of the page is there
  page.complaints.length = 0;
  await page.browser.call("Page.addScriptToEvaluateOnNewDocument", { source: `
    const { getContext } = HTMLCanvasElement.prototype;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
      return kind.startsWith("webgl") ? null : getContext.call(this, kind, ...rest);
    };` });
  await page.go();
  assert.match(await page.textOf(".view"), /3D needs WebGL/);
  assert.ok(await page.visible(".plot-place svg") > 2);
  await page.seek(2);
  assert.equal(await page.is("gnbv.views(0)"), 2);
  assert.deepEqual(page.complaints.filter((text) => !text.includes("WebGL")), []);
} finally {
  await page.close();
}
