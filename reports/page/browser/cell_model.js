// One broken body as objects of three.js: fragments that explode and move, balls, the impact.

import {
  ArrowHelper,
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  Mesh,
  MeshStandardMaterial,
  SphereGeometry,
  Vector3,
} from "three";
import { ballTracks, place, trackOf } from "./motion.js";

const original = "#8fa3b5";
const grey = "#9a9a9a";
const hit = "#e0245e";

function fragmentMesh(fragment, outside, inside) {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(fragment.vertices, 3));
  geometry.setIndex(new BufferAttribute(fragment.indices, 1));
  const split = 3 * fragment.original;
  geometry.addGroup(0, split, 0);
  geometry.addGroup(split, fragment.indices.length - split, 1);
  geometry.computeBoundingBox();
  return new Mesh(geometry, [outside, inside]);
}

export class CellModel {
  /// `look`: the palette of the page.
  constructor(cell, look) {
    this.cell = cell;
    this.look = look;
    this.group = new Group();
    this.centre = new Vector3();
    this.parts = cell.fragments.map((fragment, number) => {
      const material = () =>
        new MeshStandardMaterial({ flatShading: true, roughness: 0.85, metalness: 0 });
      const mesh = fragmentMesh(fragment, material(), material());
      // The body's pose moves the holder, exploding moves the mesh in it.
      const holder = new Group();
      holder.add(mesh);
      this.group.add(holder);
      const centre = mesh.geometry.boundingBox.getCenter(new Vector3());
      return { fragment, mesh, holder, number, centre };
    });
    const box = new Box3();
    for (const part of this.parts) box.union(part.mesh.geometry.boundingBox);
    box.getCenter(this.centre);
    this.size = box.getSize(new Vector3()).length();
    this.addImpact();
    this.addBalls();
    this.colourBy("fragment");
    this.explode(0.25);
    this.rest();
  }

  addImpact() {
    this.impact = new Group();
    this.group.add(this.impact);
    const first = this.cell.impacts[0];
    for (const impulse of first?.impulses ?? []) {
      const direction = new Vector3(...impulse.direction);
      const point = new Vector3(...impulse.point);
      const length = 0.3 * this.size;
      const from = point.clone().addScaledVector(direction, -length);
      this.impact.add(new ArrowHelper(direction, from, length, hit, 0.25 * length, 0.12 * length));
    }
  }

  addBalls() {
    this.balls = ballTracks(this.cell).map((track) => {
      const radius = this.cell.balls[track.index] ?? 0.1;
      const material = new MeshStandardMaterial({ color: grey, roughness: 0.5 });
      const mesh = new Mesh(new SphereGeometry(radius, 32, 16), material);
      this.group.add(mesh);
      return { track, mesh };
    });
  }

  colourBy(kind) {
    const colours = this.look.fragment_colours;
    for (const { mesh, number } of this.parts) {
      const own = new Color(colours[number % colours.length]);
      const fracture = new Color(this.look.fracture_colour);
      mesh.material[0].color = kind === "fragment" ? own : new Color(original);
      mesh.material[1].color =
        kind === "fragment" ? own.clone().lerp(fracture, 0.35) : new Color("#d9822b");
    }
  }

  setWireframe(on) {
    for (const { mesh } of this.parts) for (const m of mesh.material) m.wireframe = on;
  }

  /// Moves the fragments apart, by `amount` times their distance from the middle of the body.
  explode(amount) {
    for (const { mesh, centre } of this.parts) {
      mesh.position.subVectors(centre, this.centre).multiplyScalar(amount);
    }
  }

  /// The body as if it had never moved, with the impact.
  rest() {
    this.impact.visible = true;
    for (const { mesh } of this.balls) mesh.visible = false;
    for (const { holder } of this.parts) {
      holder.position.set(0, 0, 0);
      holder.quaternion.identity();
    }
  }

  /// The recorded motion at a frame.
  move(frame) {
    this.impact.visible = false;
    for (const { mesh, track } of this.balls) {
      mesh.visible = frame >= track.first_frame && frame < track.first_frame + track.frames;
      place(mesh, track, frame);
    }
    for (const { holder, fragment } of this.parts) {
      const track = trackOf(this.cell, fragment, frame);
      if (track) place(holder, track, frame);
    }
  }

  dispose() {
    this.group.traverse((object) => {
      object.geometry?.dispose();
      for (const material of [object.material ?? []].flat()) material.dispose();
    });
  }
}
