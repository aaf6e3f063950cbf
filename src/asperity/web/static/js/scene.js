/** Worm and wheel in space: turned by their ratio, with the lines on which they touch. */
import { colourAt } from "./colours.js";

const STEEL = 0xaeb6bf;
const BRONZE = [0.85, 0.66, 0.38];
const SIDES = 6;
/** From the body to the eye, by part. */
const VIEWS = { whole: [0.55, 0.45, 1], mesh: [0.75, 0.3, 1], tooth: [1.2, 0.5, 0.8] };

/** The nearest angle that has contact lines. */
export const nearest = ({ pitch, angles }, phi) => Math.round((phi / pitch) * angles) % angles;

/** Points and triangles of several pieces as one. */
function merged(pieces) {
  const points = new Float32Array(pieces.reduce((sum, [some]) => sum + some.length, 0));
  const index = new Uint32Array(pieces.reduce((sum, [, some]) => sum + some.length, 0));
  let [at, corner] = [0, 0];
  for (const [some, triangles] of pieces) {
    points.set(some, at);
    for (let k = 0; k < triangles.length; k += 1) index[corner + k] = triangles[k] + at / 3;
    at += some.length;
    corner += triangles.length;
  }
  return [points, index];
}

/** A prism along y from 0 to 1, which a piece of line is drawn as. */
function prism() {
  const points = new Float32Array(SIDES * 6);
  const index = [];
  for (let k = 0; k < SIDES; k += 1) {
    const angle = (2 * Math.PI * k) / SIDES;
    points.set([Math.cos(angle), 0, Math.sin(angle), Math.cos(angle), 1, Math.sin(angle)], 6 * k);
    const [a, b] = [2 * k, 2 * ((k + 1) % SIDES)];
    index.push(a, b, a + 1, b, b + 1, a + 1);
  }
  return [points, new Uint16Array(index)];
}

/** The matrix that takes the prism from one end of a piece to the other. */
function placed(out, at, p, thick) {
  const [dx, dy, dz] = [p[3] - p[0], p[4] - p[1], p[5] - p[2]];
  const length = Math.hypot(dx, dy, dz) || 1e-9;
  const flat = Math.hypot(dx, dz) || 1e-9;
  const [ux, uz] = [(thick * dz) / flat, (-thick * dx) / flat];
  const scale = thick / length / flat;
  out.set([ux, 0, uz, 0, dx, dy, dz, 0], at);
  out.set([-scale * dx * dy, scale * (dx * dx + dz * dz), -scale * dz * dy, 0, p[0], p[1], p[2], 1], at + 8);
}

/**
 * Draw a gearset on a canvas.
 * @returns {Promise<null | {show: (what: any) => void, turn: (phi: number) => void,
 *   picture: (phi: number) => string, close: () => void}>}
 *   null where there is no WebGL
 */
export async function stage(canvas, { header, arrays }) {
  if (!document.createElement("canvas").getContext("webgl2")) return null;
  const three = await import("../vendor/three.js");
  const renderer = new three.WebGLRenderer({ canvas, antialias: true, alpha: true });
  /** @param {any[]} of */
  const geometry = ([points, index]) => {
    const made = new three.BufferGeometry();
    made.setAttribute("position", new three.BufferAttribute(points, 3));
    made.setIndex(new three.BufferAttribute(index, 1));
    made.computeVertexNormals();
    return made;
  };
  const body = (name) => geometry([arrays[`${name}.points`], arrays[`${name}.triangles`]]);
  const steel = { metalness: 0.25, roughness: 0.5, side: three.DoubleSide };
  const metal = (more) => new three.MeshStandardMaterial({ ...steel, ...more });
  const bronze = new three.Color(...BRONZE);
  const { starts, teeth, fine: count, pitch } = header;
  const step = (2 * Math.PI) / teeth;
  const flanks = ["+1", "-1"].map((side) => [arrays[`flank.points.${side}`], arrays[`flank.triangles.${side}`]]);
  const besides = arrays["beside.points"].length / 3;
  const worm = new three.Mesh(body("worm"), metal({ color: STEEL }));
  const hub = new three.Mesh(body("hub"), metal({ color: bronze }));
  const toothGeometry = geometry(merged([[arrays["beside.points"], arrays["beside.triangles"]], ...flanks]));
  const colours = new three.BufferAttribute(new Float32Array(toothGeometry.attributes.position.count * 3), 3);
  toothGeometry.setAttribute("color", colours);
  const fine = new three.InstancedMesh(toothGeometry, metal({ vertexColors: true }), count);
  const coarse = new three.InstancedMesh(body("tooth"), metal({ color: bronze }), Math.max(teeth - count, 1));
  const begins = ["+1", "-1"].map((side) => [...arrays[`lines.begin.${side}`]]);
  const most = Math.max(...begins.flatMap((begin) => begin.slice(1).map((end, n) => end - begin[n])));
  const lines = new three.InstancedMesh(geometry(prism()), new three.MeshBasicMaterial({ color: 0xd81b1b }), most);
  lines.frustumCulled = false;
  const wheel = new three.Group();
  wheel.add(hub, fine, coarse);
  const scene = new three.Scene();
  const lamp = new three.DirectionalLight(0xffffff, 2.2);
  const camera = new three.PerspectiveCamera(30, 1, 1, 5000);
  camera.add(lamp);
  lamp.position.set(0.4, 0.8, 1);
  scene.add(new three.HemisphereLight(0xffffff, 0x8890a0, 1.6), camera, wheel, worm, lines);

  const spin = new three.Matrix4();
  for (let k = 0; k < teeth; k += 1) {
    // The middle one first, then its neighbours.
    const place = k % 2 ? (k + 1) / 2 : -k / 2;
    spin.makeRotationZ(place * step);
    if (k < count) fine.setMatrixAt(k, spin);
    else coarse.setMatrixAt(k - count, spin);
  }
  const rows = header.worm.rotation.flatMap((row, k) => [...row, header.worm.place[k]]);
  const standing = new three.Matrix4().set(...rows, 0, 0, 0, 1);
  worm.matrixAutoUpdate = false;

  /** @type {any} */
  const now = { part: "", side: "", worm: "clear", values: null, range: [0, 1], phi: 0 };
  const controls = new three.OrbitControls(camera, canvas);
  controls.listenToKeyEvents(canvas);
  let waiting = 0;
  const draw = () => {
    waiting = 0;
    renderer.render(scene, camera);
  };
  const soon = () => (waiting ||= requestAnimationFrame(draw));
  controls.addEventListener("change", soon);
  const fit = () => {
    const { clientWidth: width, clientHeight: height } = canvas;
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    renderer.setSize(width, height, false);
    camera.aspect = width / Math.max(height, 1);
    camera.updateProjectionMatrix();
    soon();
  };
  const watched = new ResizeObserver(fit);
  watched.observe(canvas);

  function look() {
    const { wheel_radius: radius, worm_radius: thick, face_width: face, centre_distance: a } = header;
    const [height, reach] = {
      whole: [(a + thick - radius) / 2, (a + thick + radius) / 1.7], mesh: [radius, face * 1.15 + thick],
      tooth: [radius - face / 6, face * 0.75],
    }[now.part];
    controls.target.set(0, height, 0);
    // From where the flank that bears is seen.
    const [x, y, z] = VIEWS[now.part];
    const away = reach / Math.tan((15 * Math.PI) / 180);
    camera.position.set(Number(now.side) * x, y, z).normalize().multiplyScalar(away).add(controls.target);
    camera.near = reach / 20;
    camera.far = 40 * reach;
    camera.updateProjectionMatrix();
    controls.update();
  }

  function colour() {
    for (let k = 0; k < colours.count; k += 1) colours.setXYZ(k, ...BRONZE);
    const { values } = now;
    if (values) {
      const first = besides + (now.side === "+1" ? 0 : flanks[0][0].length / 3);
      const [low, high] = now.range;
      const shade = new three.Color();
      values.forEach((value, k) => {
        if (!Number.isFinite(value)) return;
        shade.setRGB(...colourAt((value - low) / (high - low)).map((each) => each / 255), "srgb");
        colours.setXYZ(first + k, shade.r, shade.g, shade.b);
      });
    }
    colours.needsUpdate = true;
  }

  function pose() {
    const { phi, side, part } = now;
    const ahead = header.sides[side].ahead;
    const turned = (phi * starts) / teeth + ahead;
    wheel.rotation.z = part === "tooth" ? 0 : turned;
    worm.matrix.copy(standing).multiply(spin.makeRotationZ(phi));
    const n = nearest(header, phi);
    const [from, to] = arrays[`lines.begin.${side}`].slice(n, n + 2);
    const [ends, tooth] = [arrays[`lines.points.${side}`], arrays[`lines.tooth.${side}`]];
    const thick = header.face_width * 0.016;
    const at = (n * pitch) / header.angles;
    const p = new Float32Array(6);
    for (let k = from; k < to; k += 1) {
      // Onto the tooth at the angle they are of, and with it to where it stands now.
      const back = part === "tooth" ? -((at * starts) / teeth + ahead) - tooth[k] * step
        : ((phi - at) * starts) / teeth;
      const [c, s] = [Math.cos(back), Math.sin(back)];
      for (const e of [0, 3]) {
        const [x, y] = [ends[6 * k + e], ends[6 * k + e + 1]];
        p[e] = c * x - s * y;
        p[e + 1] = s * x + c * y;
        p[e + 2] = ends[6 * k + e + 2];
      }
      placed(lines.instanceMatrix.array, 16 * (k - from), p, thick);
    }
    lines.count = to - from;
    lines.instanceMatrix.needsUpdate = true;
    soon();
  }

  function turn(phi) {
    now.phi = phi;
    pose();
  }

  return {
    show(what) {
      const moved = what.part !== now.part || what.side !== now.side;
      Object.assign(now, what);
      hub.visible = coarse.visible = now.part === "whole";
      fine.count = now.part === "tooth" ? 1 : count;
      worm.visible = now.part !== "tooth" && now.worm !== "none";
      const clear = now.worm === "clear";
      const seen = { transparent: clear, opacity: clear ? 0.3 : 1, depthWrite: !clear };
      const side = clear ? three.FrontSide : three.DoubleSide;
      Object.assign(worm.material, { ...seen, side, needsUpdate: true });
      colour();
      if (moved) look();
      pose();
    },
    turn,
    /** As a data URL. */
    picture(phi) {
      turn(phi);
      draw();
      return canvas.toDataURL("image/webp", 0.8);
    },
    close() {
      cancelAnimationFrame(waiting);
      watched.disconnect();
      controls.dispose();
      renderer.dispose();
    },
  };
}
