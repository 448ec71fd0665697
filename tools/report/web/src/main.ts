// The page of `gnbv report`: reads what the program wrote into it, and puts the parts together.
import { Clock } from "./clock";
import { runColour, setRamps } from "./colours";
import { Replay, listenToKeys, makeLayerBar, makeTransport } from "./controls";
import { Bytes, readPage } from "./data";
import { make } from "./dom";
import { Flight } from "./flight";
import * as panels from "./panels";
import { Plots } from "./plots";
import { RunScene } from "./run_scene";
import { makeStage } from "./stage";

function setRunColours(count: number) {
  for (let i = 0; i < count; ++i) {
    document.documentElement.style.setProperty(`--run-${i}`, runColour(i));
  }
}

function build() {
  const page = readPage();
  setRamps(page.ramps);
  const flights = page.runs.map((run, i) => new Flight(run, new Bytes(`run-${i}`), i));
  const meshBytes = new Bytes("meshes");
  const scenes = flights.map((flight) =>
    new RunScene(flight, page.meshes[flight.data.mesh], meshBytes));
  const clock = new Clock();
  const replay = new Replay(clock);
  const stage = makeStage(scenes, clock);
  const plots = new Plots(clock);
  const strip = new panels.FrameStrip();
  const words = make("p", { class: "readout", "aria-live": "off" });
  const key = make("div", { class: "key" });
  // more panes are too small
  const shown = new Set(flights.slice(0, 4).map((flight) => flight.index));
  const shownFlights = () => flights.filter((flight) => shown.has(flight.index));

  clock.onChange(() => {
    words.replaceChildren(...shownFlights().map((flight) => make("span", {},
      flights.length > 1 ? make("span", { class: `dot run-${flight.index}` }) : null,
      panels.readout(flight, clock))));
    strip.show(shownFlights(), clock);
  });
  const setShown = () => {
    stage.setShown(scenes.filter((scene) => shown.has(scene.flight.index)));
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
  };
  const layerBar = makeLayerBar(stage, has, (by) =>
    panels.showColourKey(key, by, scenes.find((scene) => scene.model.cloud)?.model));
  if (stage.canDraw) stage.element.append(key);

  setRunColours(flights.length);
  const isAlone = flights.length === 1;
  document.getElementById("app")!.replaceChildren(
    panels.makeHeader(page),
    make("main", {},
      panels.makeMissing(page.runs) ?? "",
      isAlone ? panels.makeTiles(page.runs[0])
        : panels.makeRunTable(page.runs, shown, setShown),
      make("div", { class: isAlone ? "board" : "board several" },
        make("section", { class: "mission", "aria-label": "The mission in 3D" },
          make("div", { class: "card view" }, stage.canDraw ? layerBar : null, stage.element,
            makeTransport(replay, words), words),
          strip.element),
        plots.element),
      page.tables.length > 0 ? make("section", {}, make("h2", {}, "Beside the paper"),
        ...page.tables.map(panels.makeTable)) : "",
      panels.makeConfiguration(page.runs)),
    panels.makeFooter(page));
  setShown();
  replay.moveTo(replay.last());
  listenToKeys(replay);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    setRunColours(flights.length);
    stage.setTheme();
    plots.rebuild();
  });
  // for scripts and tests: gnbv.seek(views), gnbv.pose(run) as x, y, z, yaw of what is drawn,
  // gnbv.views(run) at the present place of the replay, gnbv.points(run) that the voxels hold there,
  // gnbv.plan(run) of views that a tour's plan still has there, gnbv.camera() where the 3D view is
  // seen from
  Object.assign(window, { gnbv: {
    seek: (views: number) => { replay.setEffort("views"); replay.moveTo(views); },
    views: (run: number) => flights[run].viewsAt(clock),
    points: (run: number) => scenes[run].model.countedPoints(),
    plan: (run: number) => scenes[run].plan?.count ?? 0,
    camera: () => stage.cameraPosition(),
    pose: (run: number) => {
      const { position: p, quaternion: q } = scenes[run].vehicle;
      return [p.x, p.y, p.z, 2 * Math.atan2(q.z, q.w)];
    },
  } });
}

build();
