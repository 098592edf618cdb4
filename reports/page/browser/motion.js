// Where bodies are at a time: tracks of poses, one a frame, as the scene recorded them.

import { Quaternion, Vector3 } from "three";

export const target = 0;
export const ball = 1;
export const piece = 2;

const positionA = new Vector3();
const positionB = new Vector3();
const turnA = new Quaternion();
const turnB = new Quaternion();

function read(track, frame, position, turn) {
  const at = 7 * frame;
  const p = track.poses;
  position.set(p[at], p[at + 1], p[at + 2]);
  turn.set(p[at + 4], p[at + 5], p[at + 6], p[at + 3]);
}

/// Puts the object where the track is at that frame, a real number.
export function place(object, track, frame) {
  const local = Math.min(Math.max(frame - track.first_frame, 0), track.frames - 1);
  const before = Math.floor(local);
  const after = Math.min(before + 1, track.frames - 1);
  read(track, before, positionA, turnA);
  read(track, after, positionB, turnB);
  object.position.lerpVectors(positionA, positionB, local - before);
  object.quaternion.slerpQuaternions(turnA, turnB, local - before);
}

/// The track that a fragment follows at that frame: its own, before that its parent's, before that
/// the target's.
export function trackOf(cell, fragment, frame) {
  const tracks = cell.trajectory.tracks;
  const own = tracks.find((t) => t.kind === piece && t.index === fragment.piece);
  if (own && frame >= own.first_frame) return own;
  const parent = tracks.find((t) => t.kind === piece && t.index === fragment.parent);
  if (parent && frame >= parent.first_frame) return parent;
  return tracks.find((t) => t.kind === target) ?? own;
}

export function ballTracks(cell) {
  return cell.trajectory.tracks.filter((t) => t.kind === ball);
}
