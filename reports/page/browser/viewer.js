// The viewer: which cells are shown, and the controls.

import { Vector3 } from "three";
import { loadCell } from "./cell_data.js";
import { CellModel } from "./cell_model.js";
import { Player } from "./player.js";
import { Stage } from "./stage.js";

const controls = `
  <div class="controls">
    <label>shape <select data-part="shape"></select></label>
    <label>collision <select data-part="scenario"></select></label>
    <fieldset data-part="methods"><legend>methods</legend></fieldset>
  </div>
  <div class="stage">
    <canvas tabindex="0" aria-label="Fragments; arrow keys move, space plays, e and E pull apart"></canvas>
    <div class="panels" data-part="panels"></div>
  </div>
  <div class="controls">
    <label>apart <input type="range" data-part="apart" min="0" max="1.5" step="0.01" value="0.25"></label>
    <label>colour <select data-part="colour">
      <option value="fragment">by fragment</option>
      <option value="surface">original and fracture surface</option>
    </select></label>
    <label><input type="checkbox" data-part="wire"> wireframe</label>
    <button data-part="play">play</button>
    <label>time <input type="range" data-part="time" min="0" max="0" step="0.01" value="0"></label>
    <output data-part="clock"></output>
    <label>speed <select data-part="speed">
      <option value="1">1</option><option value="0.25" selected>1/4</option>
      <option value="0.0625">1/16</option>
    </select></label>
    <button data-part="rest">at rest</button>
    <button data-part="save">save picture</button>
  </div>
  <p class="note" data-part="message" role="status"></p>`;

const unique = (values) => [...new Set(values)];
const collisionOf = (cell) => `${cell.scenario}${cell.repeat ? ` (repeat ${cell.repeat})` : ""}`;

export class Viewer {
  constructor(place, index) {
    this.index = index;
    place.innerHTML = controls;
    this.parts = {};
    for (const element of place.querySelectorAll("[data-part]")) {
      this.parts[element.dataset.part] = element;
    }
    this.canvas = place.querySelector("canvas");
    this.models = [];
    this.moving = false;
    this.request = 0;
    try {
      this.stage = new Stage(this.canvas);
    } catch (error) {
      place.innerHTML = `<p>The viewer needs WebGL, which this browser does not offer: ${error.message}</p>`;
      return;
    }
    this.player = new Player(() => this.showTime());
    this.connect();
  }

  start() {
    if (!this.stage) return;
    const { shape } = this.parts;
    for (const name of unique(this.index.cells.map((cell) => cell.shape))) shape.add(new Option(name));
    this.offerCollisions();
    // Models are loaded once the viewer is near what is seen.
    new IntersectionObserver((entries, observer) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      observer.disconnect();
      this.load();
    }).observe(this.canvas);
  }

  connect() {
    const { shape, scenario, apart, colour, wire, play, time, speed, rest, save } = this.parts;
    shape.addEventListener("change", () => {
      this.offerCollisions();
      this.load();
    });
    scenario.addEventListener("change", () => {
      this.offerMethods();
      this.load();
    });
    for (const control of [apart, colour, wire]) {
      control.addEventListener("input", () => this.applyLook());
    }
    play.addEventListener("click", () => this.play());
    time.addEventListener("input", () => {
      this.moving = true;
      this.player.seek(Number(time.value));
    });
    speed.addEventListener("change", () => (this.player.speed = Number(speed.value)));
    this.player.speed = Number(speed.value);
    rest.addEventListener("click", () => this.backToRest());
    save.addEventListener("click", () => this.savePicture());
    this.canvas.addEventListener("keydown", (event) => this.key(event));
  }

  key(event) {
    const { apart } = this.parts;
    const actions = {
      " ": () => this.play(),
      e: () => (apart.value = Number(apart.value) + 0.05),
      E: () => (apart.value = Number(apart.value) - 0.05),
      ",": () => this.step(-1),
      ".": () => this.step(1),
    };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
    if (event.key === "e" || event.key === "E") this.applyLook();
  }

  /// The cells of the shape that is chosen.
  ofShape() {
    return this.index.cells.filter((cell) => cell.shape === this.parts.shape.value);
  }

  chosenCells() {
    const wanted = [...this.parts.methods.querySelectorAll("input:checked")].map((i) => i.value);
    return this.ofShape().filter(
      (cell) => collisionOf(cell) === this.parts.scenario.value && wanted.includes(cell.method),
    );
  }

  offerCollisions() {
    const { scenario } = this.parts;
    const cells = this.ofShape();
    const names = unique(cells.map(collisionOf));
    scenario.replaceChildren(...names.map((name) => new Option(name)));
    // The first collision that broke the body for most of the methods.
    const broken = (name) => cells.filter((c) => collisionOf(c) === name && c.fragments > 1).length;
    scenario.value = names.reduce((best, name) => (broken(name) > broken(best) ? name : best), names[0]);
    this.offerMethods();
  }

  offerMethods(only) {
    const { methods, scenario } = this.parts;
    const cells = this.ofShape().filter((cell) => collisionOf(cell) === scenario.value);
    const legend = methods.querySelector("legend");
    const before = [...methods.querySelectorAll("input")];
    methods.replaceChildren(
      legend,
      ...cells.map((cell) => {
        const known = before.find((input) => input.value === cell.method);
        const label = document.createElement("label");
        const box = document.createElement("input");
        box.type = "checkbox";
        box.value = cell.method;
        box.checked = only ? cell.key === only : (known?.checked ?? true);
        box.addEventListener("change", () => this.load());
        label.append(box, ` ${cell.method}`);
        return label;
      }),
    );
  }

  /// Shows one cell alone.
  show(key) {
    const cell = this.index.cells.find((c) => c.key === key);
    this.parts.shape.value = cell.shape;
    this.offerCollisions();
    this.parts.scenario.value = collisionOf(cell);
    this.offerMethods(key);
    return this.load();
  }

  async load() {
    const request = ++this.request;
    const cells = this.chosenCells();
    this.say(cells.length ? "loading" : "choose a method");
    const results = await Promise.allSettled(cells.map((cell) => loadCell(cell.key)));
    if (request !== this.request) return;
    const failed = results.find((result) => result.status === "rejected");
    this.say(failed ? failed.reason.message : "");
    const ready = cells
      .map((cell, k) => ({ cell, data: results[k].value }))
      .filter(({ data }) => data);
    for (const model of this.models) model.dispose();
    this.models = ready.map(({ data }) => new CellModel(data, this.index));
    this.arrange(ready.map(({ cell }) => cell));
    this.applyLook();
    this.backToRest();
  }

  /// A panel for each model, and the camera on the body, which all have in common.
  arrange(cells) {
    const { panels, time } = this.parts;
    panels.replaceChildren(
      ...cells.map((cell) => {
        const panel = document.createElement("div");
        const count = cell.status === "unbroken" ? "unbroken" : `${cell.fragments} fragments`;
        const state = ["ok", "unbroken"].includes(cell.status) ? "" : `, ${cell.status}`;
        panel.innerHTML = "<span></span>";
        panel.firstChild.textContent = `${cell.method}: ${count}${state}`;
        return panel;
      }),
    );
    this.stage.set(
      this.models.map((model, k) => ({ model, element: panels.children[k] })),
    );
    const frames = Math.max(0, ...this.models.map((model) => model.cell.frames));
    this.player.setLength(frames, this.models[0]?.cell.trajectory.frame_seconds);
    time.max = Math.max(frames - 1, 0);
    const model = this.models[0];
    const body = cells[0] && `${cells[0].shape} ${collisionOf(cells[0])}`;
    if (!model || body === this.lookedAt) return;
    this.lookedAt = body;
    const impulse = model.cell.impacts[0]?.impulses[0];
    this.stage.look(model.centre, model.size, impulse && new Vector3(...impulse.direction));
  }

  applyLook() {
    const { apart, colour, wire } = this.parts;
    for (const model of this.models) {
      model.explode(Number(apart.value));
      model.colourBy(colour.value);
      model.setWireframe(wire.checked);
    }
    this.stage.draw();
  }

  play() {
    this.moving = true;
    this.parts.apart.value = 0;
    this.applyLook();
    this.player.toggle();
  }

  step(frames) {
    this.moving = true;
    this.player.pause();
    this.player.seek(Math.round(this.player.frame) + frames);
  }

  backToRest() {
    this.moving = false;
    this.player.pause();
    this.player.seek(0);
  }

  showTime() {
    if (!this.player) return;
    const { time, clock, play } = this.parts;
    play.textContent = this.player.playing ? "pause" : "play";
    time.value = this.player.frame;
    clock.value = `${(this.player.frame * this.player.frameSeconds).toFixed(2)} s`;
    for (const model of this.models) {
      if (this.moving) model.move(this.player.frame);
      else model.rest();
    }
    this.stage.draw();
  }

  say(text) {
    this.parts.message.textContent = text;
  }

  savePicture() {
    this.stage.render();
    const link = document.createElement("a");
    link.download = `${this.parts.shape.value}-${this.parts.scenario.value}.png`;
    link.href = this.canvas.toDataURL("image/png");
    link.click();
  }
}
