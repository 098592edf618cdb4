// The report page in a real browser: runs a small suite, reports on it and opens the page from the
// disk. Called with the program and a folder to work in; exit code 77 where there is no browser.

import { execFileSync } from "node:child_process";
import { existsSync, mkdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [program, folder, packages] = process.argv.slice(2);
const skip = (why) => {
  console.log(`skipped: ${why}`);
  process.exit(77);
};
const browserPath = ["/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"].find(
  existsSync,
);
if (!browserPath) skip("no Chromium; install the Debian package chromium");
if (!existsSync(path.join(packages, "playwright-core"))) skip("npm package playwright-core is missing");
const { chromium } = createRequire(path.join(packages, "x.js"))("playwright-core");

let failures = 0;
const expect = (holds, what) => {
  console.log(`${holds ? "ok  " : "FAIL"} ${what}`);
  if (!holds) ++failures;
};

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
writeFileSync(
  path.join(folder, "page.toml"),
  `shapes = ["cube"]
[[scenario]]
family = "single"
count = 3
[[method]]
name = "cvd"
sites = 6
[[method]]
name = "cvd"
label = "cvd-12"
sites = 12
`,
);
const run = (...args) => execFileSync(program, args, { cwd: folder, stdio: ["ignore", "pipe", "inherit"] });
run("run", "page.toml", "--out", "results");
run("report", "results", "--out", "report");

const browser = await chromium.launch({
  executablePath: browserPath,
  args: [
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-quic",
  ],
});
try {
  const page = await browser.newPage({ viewport: { width: 1200, height: 900 } });
  const complaints = [];
  const requests = [];
  page.on("console", (m) => ["error", "warning"].includes(m.type()) && complaints.push(m.text()));
  page.on("pageerror", (error) => complaints.push(error.message));
  page.on("request", (request) => requests.push(request.url()));
  await page.goto(pathToFileURL(path.join(folder, "report", "index.html")).href);
  await page.waitForFunction(() => window.fracbenchViewer?.models.length === 2);

  // Colours of the canvas on a coarse grid, and whether they changed.
  const picture = () =>
    page.evaluate(() => {
      window.fracbenchViewer.stage.render();
      const canvas = document.querySelector("canvas");
      const copy = document.createElement("canvas");
      copy.width = 120;
      copy.height = 60;
      const context = copy.getContext("2d");
      context.drawImage(canvas, 0, 0, 120, 60);
      return [...context.getImageData(0, 0, 120, 60).data];
    });
  const share = (pixels) => {
    let opaque = 0;
    for (let i = 3; i < pixels.length; i += 4) opaque += pixels[i] > 0;
    return opaque / (pixels.length / 4);
  };
  const differ = (a, b) => a.filter((value, i) => Math.abs(value - b[i]) > 8).length / a.length;

  const first = await picture();
  expect(share(first) > 0.1, `fragments are drawn (${(100 * share(first)).toFixed(0)} % of the canvas)`);
  const set = (part, value) =>
    page.$eval(
      `[data-part=${part}]`,
      (element, v) => {
        element.value = v;
        element.dispatchEvent(new Event("input"));
        element.dispatchEvent(new Event("change"));
      },
      value,
    );
  await set("apart", "1");
  const apart = await picture();
  expect(differ(first, apart) > 0.02, "the slider pulls the fragments apart");
  await set("colour", "surface");
  expect(differ(apart, await picture()) > 0.02, "colours by surface differ from those by fragment");
  await set("apart", "0");

  const frames = await page.$eval("[data-part=time]", (time) => Number(time.max));
  expect(frames > 10, `a motion was recorded (${frames + 1} frames)`);
  await set("time", String(frames));
  const end = await picture();
  await set("time", "0");
  expect(differ(end, await picture()) > 0.01, "scrubbing moves the bodies");
  await page.focus("canvas");
  await page.keyboard.press(" ");
  await page.waitForFunction(() => window.fracbenchViewer.player.frame > 1);
  await page.keyboard.press(" ");
  const paused = await page.evaluate(() => [
    window.fracbenchViewer.player.playing,
    window.fracbenchViewer.player.frame,
  ]);
  expect(paused[0] === false && paused[1] > 1, "space plays and pauses");

  const column = () =>
    page.$$eval("#cells tbody tr", (rows) => rows.map((row) => Number(row.cells[5].dataset.value)));
  const heads = await page.$$("#cells th button");
  await heads[5].click();
  const rising = await column();
  await heads[5].click();
  const falling = await column();
  const sorted = [...rising].sort((a, b) => a - b);
  expect(rising.length === 6 && rising.join() === sorted.join(), "tables sort by number");
  expect(falling.join() === sorted.reverse().join(), "and the other way round");

  await page.click("#cells tr[data-cell] button:text('look')");
  await page.waitForFunction(() => window.fracbenchViewer.models.length === 1);
  expect(true, "a line of the table of cells opens its cell");

  const loaded = await page.$$eval(".pictures img", (images) =>
    Promise.all(images.map((image) => ((image.loading = "eager"), image.decode().then(() => image.naturalWidth)))),
  );
  expect(loaded.length === 2 && loaded.every((width) => width === 320), "pictures are there");
  await page.focus(".pictures figure:nth-child(2)");
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => document.querySelector(".panels span")?.textContent.startsWith("cvd-12"));
  expect(true, "a picture opens its cell");

  expect((await page.$$("figure svg")).length >= 3, "figures are there");
  await page.setViewportSize({ width: 390, height: 800 });
  const overflow = await page.evaluate(
    () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
  );
  expect(overflow <= 0, `a small screen needs no scrolling aside (${overflow} px)`);
  expect(complaints.length === 0, `no complaints of the browser ${complaints.join("; ")}`);
  const outside = requests.filter((url) => !url.startsWith("file:") && !url.startsWith("data:"));
  expect(outside.length === 0, `nothing comes from a network ${outside.join(" ")}`);
} finally {
  await browser.close();
}
process.exit(failures ? 1 : 0);
