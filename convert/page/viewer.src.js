// The viewer of `ivconvert --html`: shows the model that the page holds, all of it in view.
//
// `build.sh` bundles it with three.js into viewer.js, which is what ivconvert puts into a page.

import {
  Box3,
  DirectionalLight,
  Group,
  HemisphereLight,
  PerspectiveCamera,
  Scene,
  Sphere,
  Vector3,
  WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';

/** Where the camera looks from at first. */
const DIRECTION = new Vector3(0.6, 0.45, 0.75).normalize();
const ANGLE_DEGREES = 35;

/** Tells the user, and whoever tests the page, how far it is. */
function tell(state, text) {
  document.documentElement.dataset.state = state;
  document.getElementById('message').textContent = text;
}

function modelBytes() {
  const text = document.getElementById('model').textContent.trim();
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text).buffer;
  const digits = atob(text);
  const bytes = new Uint8Array(digits.length);
  for (let i = 0; i < digits.length; i += 1) bytes[i] = digits.charCodeAt(i);
  return bytes.buffer;
}

/** Light from the sky; for models that bring none of their own, more of it, and from the eye. */
function addLight(scene, camera, hasLight) {
  scene.add(new HemisphereLight(0xffffff, 0x8a8478, hasLight ? 0.5 : 1.6));
  if (hasLight) return;
  const lamp = new DirectionalLight(0xffffff, 1.8);
  lamp.position.set(0.3, 0.5, 1);
  camera.add(lamp, lamp.target);
}

/** Puts the model's middle into the origin, so that far coordinates stay exact in 32 bits. */
function centered(model) {
  const sphere = new Box3().setFromObject(model).getBoundingSphere(new Sphere());
  const radius = sphere.radius > 0 ? sphere.radius : 1;
  const group = new Group();
  group.add(model);
  group.position.copy(sphere.center).negate();
  return { group, radius };
}

/** Takes out what the file hides (KHR_node_visibility): three.js does not know of it. */
function dropHidden(model) {
  const hidden = [];
  model.traverse((object) => {
    const visibility = object.userData.gltfExtensions?.KHR_node_visibility;
    if (visibility?.visible === false) hidden.push(object);
  });
  hidden.forEach((object) => object.removeFromParent());
}

function show({ scene: model }) {
  dropHidden(model);
  const renderer = new WebGLRenderer({ antialias: true, alpha: true });
  renderer.setPixelRatio(window.devicePixelRatio);
  document.body.append(renderer.domElement);

  const scene = new Scene();
  const camera = new PerspectiveCamera(ANGLE_DEGREES);
  scene.add(camera);
  const { group, radius } = centered(model);
  scene.add(group);
  let hasLight = false;
  model.traverse((object) => {
    hasLight ||= object.isLight === true;
  });
  addLight(scene, camera, hasLight);

  const controls = new OrbitControls(camera, renderer.domElement);
  const draw = () => renderer.render(scene, camera);
  const frame = () => {
    const half = Math.tan((ANGLE_DEGREES * Math.PI) / 360) * Math.min(1, camera.aspect);
    const distance = radius * Math.hypot(1, 1 / half);
    controls.target.set(0, 0, 0);
    camera.position.copy(DIRECTION).multiplyScalar(distance);
    controls.update();
  };
  const clip = () => {
    const distance = camera.position.length();
    camera.near = Math.max(distance - 2 * radius, radius * 1e-3);
    camera.far = distance + 2 * radius;
    camera.updateProjectionMatrix();
  };
  const resize = () => {
    camera.aspect = window.innerWidth / Math.max(1, window.innerHeight);
    renderer.setSize(window.innerWidth, window.innerHeight);
    clip();
    draw();
  };
  controls.addEventListener('change', () => {
    clip();
    draw();
  });
  window.addEventListener('resize', resize);
  window.addEventListener('keydown', ({ key }) => {
    if (key === 'f' || key === 'Home') frame();
  });
  camera.aspect = window.innerWidth / Math.max(1, window.innerHeight);
  frame();
  resize();
  tell('shown', '');
}

async function run() {
  try {
    const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
    show(await loader.parseAsync(modelBytes(), ''));
  } catch (error) {
    tell('failed', `The model cannot be shown: ${error.message}`);
  }
}

run();
