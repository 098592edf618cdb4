// Animated glTF of a record: held to the specification by Khronos' validator, and loaded and played
// in three.js. Called with the program, a folder to work in and the folder of npm packages.

import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [program, folder, packages] = process.argv.slice(2);
for (const name of ["three", "gltf-validator"]) {
  if (!existsSync(path.join(packages, name))) {
    console.log(`skipped: npm package ${name} is missing`);
    process.exit(77);
  }
}
const require = createRequire(path.join(packages, "x.js"));
const validator = require("gltf-validator");
const load = (name) => import(pathToFileURL(path.join(packages, "three", name)).href);

// The loader finds the package 'three' from where it lies.
const { GLTFLoader } = await load("examples/jsm/loaders/GLTFLoader.js");
const { AnimationMixer, Vector3 } = await load("build/three.module.js");

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
writeFileSync(
  path.join(folder, "one.toml"),
  `shapes = ["cube"]
[[scenario]]
family = "single"
count = 2
[[method]]
name = "cvd"
sites = 6
`,
);
const run = (...args) => execFileSync(program, args, { cwd: folder, stdio: ["ignore", "pipe", "inherit"] });
run("run", "one.toml", "--out", "results");

let failures = 0;
const expect = (holds, what) => {
  console.log(`${holds ? "ok  " : "FAIL"} ${what}`);
  if (!holds) ++failures;
};
for (const [k, record] of readdirSync(path.join(folder, "results", "records")).sort().entries()) {
  const file = path.join(folder, `${k}.glb`);
  run("export", path.join("results", "records", record), "--out", file);
  const bytes = new Uint8Array(readFileSync(file));
  const report = await validator.validateBytes(bytes);
  const { numErrors, numWarnings, messages } = report.issues;
  expect(numErrors === 0 && numWarnings === 0, `valid glTF ${JSON.stringify(messages.slice(0, 3))}`);

  const gltf = await new GLTFLoader().parseAsync(bytes.buffer, "");
  const nodes = gltf.scene.children;
  const named = (start) => nodes.filter((node) => node.name.startsWith(start));
  expect(named("target").length === 1, "the target is there");
  expect(named("fragment").length === 6, "and six fragments");
  expect(named("ball").length === 1, "and the ball");
  const clip = gltf.animations[0];
  const mixer = new AnimationMixer(gltf.scene);
  mixer.clipAction(clip).play();
  const seen = () => nodes.filter((node) => node.scale.x > 0.5).map((node) => node.name);
  mixer.setTime(0);
  const before = seen();
  expect(before.some((n) => n.startsWith("target")) && !before.some((n) => n.startsWith("fragment")),
    "at first there is the target and no fragment");
  const place = named("ball")[0].position.clone();
  mixer.setTime(0.98 * clip.duration);
  const after = seen();
  expect(!after.some((n) => n.startsWith("target")) && after.filter((n) => n.startsWith("fragment")).length === 6,
    "in the end there are the fragments and no target");
  expect(place.distanceTo(named("ball")[0].position) > 0.1, "the ball has moved");
  const middle = named("fragment").reduce((sum, n) => sum.add(n.position), new Vector3());
  expect([middle.x, middle.y, middle.z].every(Number.isFinite), "positions are numbers");
}
process.exit(failures ? 1 : 0);
