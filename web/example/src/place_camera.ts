import { Box3, PerspectiveCamera, Sphere, Vector3 } from 'three';
import type { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import type { GLTF } from 'three/addons/loaders/GLTFLoader.js';

/** Puts the camera where the scene's first one stands, else where all of the scene is in view. */
export function placeCamera(camera: PerspectiveCamera, controls: OrbitControls, { scene, cameras: [first] }: GLTF): void {
    const { center, radius } = new Box3().setFromObject(scene).getBoundingSphere(new Sphere());
    if (first instanceof PerspectiveCamera) {
        camera.fov = first.fov;
        first.getWorldPosition(camera.position);
        const forward = first.getWorldDirection(new Vector3());
        controls.target.copy(camera.position).addScaledVector(forward, Math.max(forward.dot(center.sub(camera.position)), radius / 10));
    } else {
        camera.position.set(0.5, 0.5, 2.5).multiplyScalar(radius).add(center);
        controls.target.copy(center);
    }
    camera.near = radius / 100;
    camera.far = radius * 100;
    controls.update();
}
