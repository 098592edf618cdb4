// Draws several models side by side with one renderer and under one camera: each panel is a part of
// one canvas.

import {
  AmbientLight,
  DirectionalLight,
  PerspectiveCamera,
  Scene,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const halfView = 0.315; // tangent of half the angle of view

export class Stage {
  constructor(canvas) {
    this.canvas = canvas;
    // Kept, so that what is drawn can be saved as a picture.
    this.renderer = new WebGLRenderer({
      canvas,
      antialias: true,
      alpha: true,
      preserveDrawingBuffer: true,
    });
    this.renderer.setClearColor(0x000000, 0);
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.camera = new PerspectiveCamera(35, 1, 0.01, 100);
    this.camera.up.set(0, 0, 1); // the axis of the shapes that stand
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = false;
    this.controls.listenToKeyEvents(canvas);
    this.controls.addEventListener("change", () => this.draw());
    this.panels = []; // { element, scene }
    this.pending = false;
    new ResizeObserver(() => this.draw()).observe(canvas);
  }

  /// Shows one model in each of the elements.
  set(panels) {
    this.panels = panels.map(({ element, model }) => {
      const scene = new Scene();
      scene.add(model.group, new AmbientLight(0xffffff, 1.4));
      const sun = new DirectionalLight(0xffffff, 2.2);
      const rim = new DirectionalLight(0xffffff, 0.7);
      sun.position.set(2, 3, 4);
      rim.position.set(-3, -1, -2);
      scene.add(sun, rim);
      return { element, scene };
    });
    this.draw();
  }

  /// Turns the camera to a body of that size, from the side that the impact came from.
  look(centre, size, from) {
    const direction = from ? from.clone().multiplyScalar(-1) : new Vector3(0, -1, 0);
    direction.add(new Vector3(0.5, 0.6, 0.45)).normalize();
    this.controls.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(direction, 1.6 * size);
    this.controls.update();
    this.draw();
  }

  /// Drawn at the next frame, once for any number of calls.
  draw() {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.render();
    });
  }

  render() {
    const box = this.canvas.getBoundingClientRect();
    if (box.width === 0 || box.height === 0) return;
    const size = this.renderer.getSize(new Vector2());
    if (size.x !== box.width || size.y !== box.height) {
      this.renderer.setSize(box.width, box.height, false);
    }
    this.renderer.setViewport(0, 0, box.width, box.height);
    this.renderer.setScissorTest(false);
    this.renderer.clear();
    this.renderer.setScissorTest(true);
    for (const { element, scene } of this.panels) {
      const part = element.getBoundingClientRect();
      const left = part.left - box.left;
      const bottom = box.bottom - part.bottom;
      this.renderer.setViewport(left, bottom, part.width, part.height);
      this.renderer.setScissor(left, bottom, part.width, part.height);
      const aspect = part.width / Math.max(part.height, 1);
      this.camera.aspect = aspect;
      // What fits into a square fits into a narrow panel, too.
      this.camera.fov = (2 * Math.atan(halfView / Math.min(aspect, 1)) * 180) / Math.PI;
      this.camera.updateProjectionMatrix();
      this.renderer.render(scene, this.camera);
    }
  }
}
