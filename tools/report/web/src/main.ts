// The page of `gnbv report`: reads what the program wrote into it, and puts the parts together.
import type { BelievedKind } from "./believed";
import { Clock } from "./clock";
import { runColour, setSlots, setRamps } from "./colours";
import { followRun } from "./live";
import { legendItems } from "./legend";
import { makeMissedList, type Region } from "./missed";
import { StateWriter, readState } from "./permalink";
import { fileName } from "./save";
import type { Layers } from "./run_scene";
import type { Colouring } from "./surfaces";
import { Replay, listenToKeys, makeLayerBar, makeTransport } from "./controls";
import { Bytes, readPage } from "./data";
import { make } from "./dom";
import { Flight } from "./flight";
import { FrameStrip } from "./frame_strip";
import { needsTwoSheets, plotHeight_px } from "./paper";
import * as panels from "./panels";
import { Plots } from "./plots";
import { RunScene } from "./run_scene";
import { viewsThatSaw } from "./seen_by";
import { makeStage } from "./make_stage";
import { Vector3 } from "three";

function setRunColours(count: number) {
  for (let i = 0; i < count; ++i) {
    document.documentElement.style.setProperty(`--run-${i}`, runColour(i));
  }
}

function build() {
  const page = readPage();
  setRamps(page.ramps);
  setSlots(page.runs.map((run) => run.slot));
  const flights = page.runs.map((run, i) => new Flight(run, new Bytes(`run-${i}`), i));
  const meshBytes = new Bytes("meshes");
  const scenes = flights.map((flight) =>
    new RunScene(flight, page.meshes[flight.data.mesh], meshBytes));
  const clock = new Clock();
  const replay = new Replay(clock);
  const stage = makeStage(scenes, clock, fileName(page.title), (view) => {
    replay.setEffort("views");
    replay.moveTo(view + 1);
  });
  const plots = new Plots(clock, plotHeight_px(needsTwoSheets(page.runs)));
  const strip = new FrameStrip();
  const words = make("p", { class: "readout", "aria-live": "off" });
  const key = make("p", { class: "legend", "aria-label": "Legend" });
  const why = make("div", { class: "why" });
  const missed = make("div", { class: "missed-list" });
  const state = readState(location.hash);
  // more panes are too small
  const asked = flights.filter((flight) => state.runs?.includes(flight.index));
  const shown = new Set((asked.length > 0 ? asked : flights.slice(0, 4))
    .map((flight) => flight.index));
  const shownFlights = () => flights.filter((flight) => shown.has(flight.index));

  clock.onChange(() => {
    words.replaceChildren(...shownFlights().map((flight) => make("span", {},
      flights.length > 1 ? make("span", { class: `dot run-${flight.index}` }) : null,
      panels.readout(flight, clock))));
    strip.show(shownFlights(), clock);
    writer.change();
  });
  const shownScenes = () => scenes.filter((scene) => shown.has(scene.flight.index));
  let layers: Layers | null = null;
  let colouring: Colouring = "height";
  // a live page that is at its end stays there when the end moves on
  const writer = new StateWriter(() => ({ effort: clock.effort,
    at: page.is_live && clock.at >= replay.last() ? Infinity : clock.at,
    camera: stage.cameraState(), colour: colouring, runs: [...shown],
    layers: Object.entries(layers ?? {}).filter(([, on]) => on).map(([name]) => name) }));
  const hasViews = () => shownFlights().some((flight) => flight.viewsAt(clock) > 0);
  const kindOfMoment = () => JSON.stringify([hasViews(),
    shownScenes().some(({ flight, model }) => model.newPoints(flight.viewsAt(clock)) > 0)]);
  let toldMoment = ""; // what the legend was made for
  const explain = () => {
    if (!layers) return;
    toldMoment = kindOfMoment();
    for (const scene of shownScenes()) { // the legend counts them
      const n = scene.flight.viewsAt(clock);
      scene.candidates?.show(n);
      scene.believed?.show(n);
    }
    key.replaceChildren(...legendItems(shownScenes(), layers, colouring,
      (scene) => scene.flight.viewsAt(clock)));
    why.replaceChildren(...!layers.candidates ? [] : shownScenes()
      .filter((scene) => scene.candidates).map((scene) => make("div", {},
        make("h3", {}, flights.length > 1 ? `Why this view: ${scene.flight.data.label}`
          : "Why this view"), scene.candidates!.table())));
  };
  clock.onChange(() => {
    const { candidates, unknown, predicted, frontiers } = layers ?? {};
    if (candidates || unknown || predicted || frontiers || toldMoment !== kindOfMoment()) explain();
  });
  const setShown = () => {
    stage.setShown(shownScenes());
    explain();
    writer.change();
    plots.setFlights(shownFlights());
    replay.setFlights(shownFlights());
  };
  const has = {
    // of all that have points: pictures side by side should mean the same
    real: flights.every((flight) => !flight.data.cloud || flight.data.cloud.colour)
      && flights.some((flight) => flight.data.cloud),
    voxels: flights.some((flight) => flight.data.voxels),
    cloud: flights.some((flight) => flight.data.cloud),
    structure: page.meshes.length > 0,
    plan: flights.some((flight) => flight.data.plan),
    surface: scenes.some((scene) => scene.surface),
    error: flights.some((flight) => flight.data.cloud?.error),
    candidates: flights.some((flight) => flight.data.candidates),
    unknown: scenes.some((scene) => scene.believed?.has("unknown")),
    predicted: scenes.some((scene) => scene.believed?.has("predicted")),
    frontiers: scenes.some((scene) => scene.believed?.has("frontiers")),
    runSurface: scenes.some((scene) => scene.runSurface),
  };
  const layerBar = makeLayerBar(stage, has, state, (chosen, by) => {
    layers = chosen;
    colouring = by;
    explain();
    writer.change();
  });
  stage.onChange(() => writer.change());

  setRunColours(flights.length);
  const isAlone = flights.length === 1;
  document.getElementById("app")!.replaceChildren(
    panels.makeHeader(page),
    make("main", {},
      isAlone ? panels.makeTiles(page.runs[0])
        : panels.makeRunTable(page.runs, shown, setShown),
      make("div", { class: `board ${isAlone ? "" : "several"} ${
        needsTwoSheets(page.runs) ? "two-sheets" : ""}` },
        make("section", { class: "mission", "aria-label": "The mission in 3D" },
          make("div", { class: "card view" }, stage.canDraw ? layerBar : null, stage.element,
            stage.canDraw ? key : null, makeTransport(replay, words), words, why),
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
    const box = [...layerBar.querySelectorAll("label")]
      .find((label) => label.textContent === "Missed")!.querySelector("input")!;
    if (!box.checked) box.click();
    stage.lookAt(scene, region.centre, back, region.radius_m);
    stage.element.scrollIntoView({ block: "nearest" });
  };
  // after the first picture: it takes its time
  setTimeout(() => missed.append(makeMissedList(scenes, showMissed) ?? ""), 300);
  setShown();
  replay.setEffort(state.effort ?? "views");
  replay.moveTo(state.at ?? replay.last());
  if (state.camera) stage.setCamera(state.camera);
  stage.drawNow();
  if (page.is_live) {
    const end = page.runs[0].figures ? " finished" : "";
    followRun(`${flights[0].count}${end}`, () => writer.write(),
      document.querySelector("header")!.appendChild(make("p", { class: "live", role: "status" })));
  }
  listenToKeys(replay);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    setRunColours(flights.length);
    stage.setTheme();
    plots.rebuild();
  });
  // for scripts and tests: gnbv.seek(views), gnbv.pose(run) as x, y, z, yaw of what is drawn,
  // gnbv.views(run) at the present place of the replay, gnbv.points(run) that the voxels hold
  // there, gnbv.found(run) of the true surface, gnbv.rays(run) ends of the chosen view's,
  // gnbv.errors(run) the scale of their colours, gnbv.candidates(run) that are drawn,
  // gnbv.believed(run, kind) voxels that are drawn, x y z indices each,
  // gnbv.frustum(run, view) ends of its pyramid's lines, gnbv.point(run, i) as x, y, z and the view that brought it, gnbv.seenBy(run, place) views,
  // gnbv.plan(run) of views that a tour's plan still has there, gnbv.camera() where the 3D view is
  // seen from, gnbv.pictures() how many were drawn of it
  Object.assign(window, { gnbv: {
    seek: (views: number) => { replay.setEffort("views"); replay.moveTo(views); },
    views: (run: number) => flights[run].viewsAt(clock),
    points: (run: number) => scenes[run].model.countedPoints(),
    rays: (run: number) => scenes[run].candidates?.rayEnds() ?? [],
    errors: (run: number) => scenes[run].model.errors,
    found: (run: number) => scenes[run].surface?.counts() ?? null,
    candidates: (run: number) => scenes[run].candidates?.count ?? 0,
    believed: (run: number, kind: BelievedKind) => scenes[run].believed?.drawn(kind) ?? [],
    frustum: (run: number, view: number) => scenes[run].frusta.lines(view),
    point: (run: number, i: number) => scenes[run].model.point(i),
    seenBy: (run: number, place: number[]) =>
      viewsThatSaw(new Vector3(...place), scenes[run]),
    plan: (run: number) => scenes[run].plan?.count ?? 0,
    camera: () => stage.cameraPosition(),
    pictures: () => ({ ...stage.pictures() }),
    pose: (run: number) => {
      const { position: p, quaternion: q } = scenes[run].vehicle;
      return [p.x, p.y, p.z, 2 * Math.atan2(q.z, q.w)];
    },
  } });
}

build();
