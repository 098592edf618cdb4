// Loads the file of a cell and turns its text into arrays. A page from a disk may not fetch, but it
// may load scripts: each file calls fracbenchCell with what it holds (docs/report-page.md).

const waiting = new Map(); // key -> { promise, resolve, reject }

function bytes(base64) {
  const text = atob(base64);
  const result = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) result[i] = text.charCodeAt(i);
  return result.buffer;
}

function decoded(cell) {
  for (const fragment of cell.fragments) {
    const places = new Uint16Array(bytes(fragment.vertices));
    const vertices = new Float32Array(places.length);
    for (let i = 0; i < places.length; ++i) {
      vertices[i] = cell.corner[i % 3] + cell.step * places[i];
    }
    fragment.vertices = vertices;
    fragment.indices = new Uint32Array(bytes(fragment.indices));
  }
  for (const track of cell.trajectory.tracks) {
    track.poses = new Float32Array(bytes(track.poses)); // x y z, then w x y z
    track.frames = track.poses.length / 7;
  }
  cell.frames = Math.max(
    0,
    ...cell.trajectory.tracks.map((track) => track.first_frame + track.frames),
  );
  return cell;
}

window.fracbenchCell = (cell) => {
  waiting.get(cell.key)?.resolve(decoded(cell));
};

/// The cell of a key; each is loaded once.
export function loadCell(key) {
  const known = waiting.get(key);
  if (known) return known.promise;
  const entry = {};
  entry.promise = new Promise((resolve, reject) => Object.assign(entry, { resolve, reject }));
  waiting.set(key, entry);
  const script = document.createElement("script");
  script.src = `cells/${key}.js`;
  script.onerror = () => {
    waiting.delete(key);
    entry.reject(new Error(`${script.src} cannot be loaded`));
  };
  script.onload = () => script.remove();
  document.head.append(script);
  return entry.promise;
}
