// The time of the recorded motion: plays, pauses, is scrubbed. Tells of every change.

export class Player {
  constructor(changed) {
    this.changed = changed;
    this.frames = 0;
    this.frame = 0;
    this.frameSeconds = 1 / 60;
    this.speed = 1;
    this.playing = false;
  }

  setLength(frames, frameSeconds) {
    this.pause();
    this.frames = frames;
    this.frameSeconds = frameSeconds || 1 / 60;
    this.frame = 0;
  }

  seek(frame) {
    this.frame = Math.min(Math.max(frame, 0), Math.max(this.frames - 1, 0));
    this.changed();
  }

  play() {
    if (this.playing || this.frames === 0) return;
    if (this.frame >= this.frames - 1) this.frame = 0;
    this.playing = true;
    let last = performance.now();
    const step = (now) => {
      if (!this.playing) return;
      this.seek(this.frame + (this.speed * (now - last)) / 1000 / this.frameSeconds);
      last = now;
      if (this.frame >= this.frames - 1) this.pause();
      requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
    this.changed();
  }

  pause() {
    this.playing = false;
    this.changed();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }
}
