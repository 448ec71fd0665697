// The page of `gnbv report`: reads what the program wrote into it, and puts the parts together.
import { Vector3 } from "three";
import type { BelievedKind } from "./believed";
import { Clock } from "./clock";
import { runColour, setLooks } from "./colours";
import { Replay, firstChoice, listenToKeys, makeLayerBar, makeTransport } from "./controls";
import { make, ofRun } from "./dom";
import { Flight } from "./flight";
import { FrameStrip } from "./frame_strip";
import { legendItems } from "./legend";
import { followRun } from "./live";
import { makeMissedList, type Region } from "./missed";
import { readPage } from "./page";
import * as panels from "./panels";
import { needsTwoSheets, plotHeight_px } from "./paper";
import { StateWriter, readState } from "./permalink";
import { Plots } from "./plots";
import { RunScene } from "./run_scene";
import { fileName } from "./save";
import { viewsThatSaw } from "./pick";
import { Stage } from "./stage";

function setRunColours(count: number) {
  for (let i = 0; i < count; ++i) {
    document.documentElement.style.setProperty(`--run-${i}`, runColour(i));
  }
}

/** The 3D view; null where the browser cannot draw it. */
function makeStage(...args: ConstructorParameters<typeof Stage>): Stage | null {
  try {
    return new Stage(...args);
  } catch (error) {
    console.warn(error);
    return null;
  }
}

function build() {
  const page = readPage();
  setLooks(page.scene, page.runs.map((run) => run.colour));
  const flights = page.runs.map((run, i) => new Flight(run, i));
  const scenes = flights.map((flight) => new RunScene(flight, page.meshes[flight.data.mesh]));
  const clock = new Clock();
  const replay = new Replay(clock);
  const stage = makeStage(scenes, clock, fileName(page.title), (view) => {
    replay.setEffort("views");
    replay.moveTo(view + 1);
  });
  const isTwoSheets = needsTwoSheets(page.runs);
  const plots = new Plots(page.plots, flights, clock, plotHeight_px(isTwoSheets));
  const strip = new FrameStrip();
  const words = make("p", { class: "readout", "aria-live": "off" });
  const key = make("p", { class: "legend", "aria-label": "Legend" });
  const why = make("div", { class: "why" });
  const missed = make("div", { class: "missed-list" });
  const state = readState(location.hash);
  const chosen = firstChoice(scenes, state);
  const asked = state.runs?.filter((run) => run in flights);
  const shown = new Set(asked && (asked.length > 0 || state.runs!.length === 0) ? asked
    : [...flights.keys()].slice(0, 4)); // more panes are too small
  const shownScenes = () => scenes.filter(({ flight }) => shown.has(flight.index));
  const shownFlights = () => shownScenes().map(({ flight }) => flight);
  const isAlone = flights.length === 1;
  // a live page that is at its end stays there when the end moves on
  const writer = new StateWriter(() => ({ effort: clock.effort,
    at: page.is_live && clock.at >= replay.last() ? Infinity : clock.at,
    camera: stage?.cameraState() ?? [], colour: chosen.colour, runs: [...shown],
    layers: Object.keys(chosen.layers).filter((name) => chosen.layers[name]) }));

  /** What the legend tells of the moment: each view, where it counts; else whether there is any. */
  const moment = () => {
    const { candidates, unknown, predicted, frontiers } = chosen.layers;
    const isCounted = candidates || unknown || predicted || frontiers;
    return shownScenes().map(({ flight, model }) => {
      const n = flight.viewsAt(clock);
      return isCounted ? n : [n > 0, n === flight.count, model.newPoints(n) > 0].join();
    }).join();
  };
  let told = ""; // the moment that the legend was made for
  const explain = () => {
    told = moment();
    for (const { flight, candidates, believed } of shownScenes()) { // the legend counts them
      candidates?.show(flight.viewsAt(clock));
      believed?.show(flight.viewsAt(clock));
    }
    key.replaceChildren(...legendItems(shownScenes(), chosen.layers, chosen.colour,
      (scene) => scene.flight.viewsAt(clock)));
    why.replaceChildren(...!chosen.layers.candidates ? [] : shownScenes()
      .filter((scene) => scene.candidates).map((scene) => make("div", {},
        make("h3", {}, isAlone ? "Why this view" : `Why this view: ${scene.flight.data.label}`),
        scene.candidates!.table())));
  };
  clock.onChange(() => {
    words.replaceChildren(...shownFlights().map((flight) => make("span", {},
      isAlone ? null : ofRun("dot", flight.index),
      panels.readout(flight, clock))));
    strip.show(shownFlights(), clock);
    if (told !== moment()) explain();
    writer.change();
  });
  const setShown = () => {
    stage?.setShown(shownScenes());
    explain();
    writer.change();
    plots.setFlights(shownFlights());
    replay.setFlights(shownFlights());
  };
  const layerBar = stage && makeLayerBar(scenes, stage, chosen, () => {
    explain();
    writer.change();
  });
  stage?.setLayers(chosen.layers);
  stage?.colour(chosen.colour);
  stage?.onChange(() => writer.change());

  setRunColours(flights.length);
  document.getElementById("app")!.replaceChildren(
    panels.makeHeader(page),
    make("main", {},
      isAlone ? panels.makeTiles(page.runs[0])
        : panels.makeRunTable(page.runs, shown, setShown),
      make("div", { class: `board ${isAlone ? "" : "several"} ${isTwoSheets ? "two-sheets" : ""}` },
        make("section", { class: "mission", "aria-label": "The mission in 3D" },
          make("div", { class: "card view" }, layerBar, stage?.element
            ?? make("div", { class: "stage none" }, make("p", { class: "nothing" },
              "3D needs WebGL, which this browser or its settings do not offer.")),
          stage && key, makeTransport(replay, words), words, why),
          strip.element),
        make("div", { class: "side" }, plots.element, missed)),
      page.tables.length > 0 ? make("section", {}, make("h2", {},
        page.tables.some((table) => table.rows.some((row) => row.includes("paper")))
          ? "Beside the paper" : "In one table"),
        ...page.tables.map(panels.makeTable)) : "",
      panels.makeMissing(page.runs) ?? "",
      panels.makeConfiguration(page.runs)),
    panels.makeFooter(page));
  const showMissed = (scene: RunScene, region: Region, back: Vector3) => {
    if (!chosen.layers.missed) {
      [...layerBar!.querySelectorAll("label")].find(({ textContent }) => textContent === "Missed")!
        .click();
    }
    stage!.lookAt(scene, region.centre, back, region.radius_m);
    stage!.element.scrollIntoView({ block: "nearest" });
  };
  // after the first picture: it takes its time
  setTimeout(() => missed.append(stage && makeMissedList(scenes, showMissed) || ""), 300);
  setShown();
  replay.setEffort(state.effort ?? "views");
  replay.moveTo(state.at ?? replay.last());
  if (state.camera) stage?.setCamera(state.camera);
  stage?.drawNow();
  if (page.is_live) {
    const end = page.runs[0].figures ? " finished" : "";
    followRun(`${flights[0].count}${end}`, () => writer.write(),
      document.querySelector("header")!.appendChild(make("p", { class: "live", role: "status" })));
  }
  listenToKeys(replay);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    setRunColours(flights.length);
    stage?.setTheme();
    explain();
    plots.rebuild();
  });
  // for scripts and tests, of a run by its number, as things are at the replay's place
  Object.assign(window, { gnbv: {
    data: page,
    seek: (views: number) => { replay.setEffort("views"); replay.moveTo(views); },
    views: (run: number) => flights[run].viewsAt(clock),
    points: (run: number) => scenes[run].model.countedPoints(), // that the voxels hold
    rays: (run: number) => scenes[run].candidates?.rayEnds() ?? [], // of the chosen view
    found: (run: number) => scenes[run].surface?.counts() ?? null, // of the true surface
    candidates: (run: number) => scenes[run].candidates?.count ?? 0, // drawn
    believed: (run: number, kind: BelievedKind) => scenes[run].believed?.drawn(kind) ?? [],
    frustum: (run: number, view: number) => scenes[run].frusta.lines(view), // ends of its lines
    point: (run: number, i: number) => scenes[run].model.point(i), // and the view that brought it
    seenBy: (run: number, place: number[]) =>
      viewsThatSaw(new Vector3(...place), scenes[run]),
    plan: (run: number) => scenes[run].plan?.count ?? 0, // views that a tour's plan still has
    camera: () => stage?.cameraPosition(),
    pictures: () => ({ ...stage?.pictures() }),
    pose: (run: number) => { // x, y, z, yaw of the vehicle as it is drawn
      const { position: p, quaternion: q } = scenes[run].vehicle;
      return [p.x, p.y, p.z, 2 * Math.atan2(q.z, q.w)];
    },
  } });
}

build();
