import type { Vec3 } from 'openprt-three';
import { MathUtils, PerspectiveCamera, type Sphere, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

import type { LoadedAsset } from '../assets/load_asset.js';

/** How much of the canvas is hidden at the right and at the bottom, in pixels of the page. */
export interface Covered {
    right: number;
    bottom: number;
}

const kNearestOfRadius = 1e-3;

/** A camera that the mouse, fingers and keys move about an asset. */
export class OrbitCamera {
    readonly camera = new PerspectiveCamera();
    readonly controls: OrbitControls;
    private verticalFovDegrees = 45;
    private bounds?: Sphere;
    private isBeingSet = false;

    /** @param onMove  told of eye and target when somebody moves the camera */
    constructor(element: HTMLElement, onMove: (eye: Vec3, target: Vec3) => void) {
        this.controls = new OrbitControls(this.camera, element);
        this.controls.addEventListener('change', () => {
            if (!this.isBeingSet) onMove(this.camera.position.toArray(), this.controls.target.toArray());
        });
    }

    /** Looks at an asset from where it wants to be seen, but for what is given. */
    look({ bounds, view }: LoadedAsset, given: { eye?: Vec3 | undefined; target?: Vec3 | undefined }): void {
        this.bounds = bounds;
        this.verticalFovDegrees = view.verticalFovDegrees;
        const eye = new Vector3().fromArray(view.eye);
        const forward = new Vector3().fromArray(view.forward);
        // Turns about what is in the middle of the picture, as far away as the middle of the asset.
        const distance = bounds.center.clone().sub(eye).dot(forward);
        const target = eye.clone().addScaledVector(forward, distance > 0 ? distance : Math.max(bounds.radius, kNearestOfRadius));
        this.isBeingSet = true;
        this.camera.position.fromArray(given.eye ?? view.eye);
        this.controls.target.fromArray(given.target ?? target.toArray());
        this.controls.maxDistance = 50 * Math.max(bounds.radius, this.camera.position.distanceTo(this.controls.target));
        this.controls.update();
        this.isBeingSet = false;
    }

    /**
     * Fits the camera to a picture of which something is covered. Where what is left is higher than wide the field of view is that of its
     * width, so that what was in view stays in view.
     */
    fit(width: number, height: number, { right, bottom }: Covered): void {
        const seenRatio = Math.max(width - right, 1) / Math.max(height - bottom, 1);
        const tangent = ((Math.tan(MathUtils.degToRad(this.verticalFovDegrees) / 2) / Math.min(seenRatio, 1)) * height) / Math.max(height - bottom, 1);
        this.camera.aspect = width / height;
        this.camera.fov = MathUtils.radToDeg(2 * Math.atan(tangent));
        this.camera.setViewOffset(width, height, right / 2, bottom / 2, width, height);
        if (this.bounds) {
            const distance = this.camera.position.distanceTo(this.bounds.center);
            const radius = Math.max(this.bounds.radius, Number.EPSILON) * 1.01;
            this.camera.near = Math.max(distance - radius, kNearestOfRadius * radius);
            this.camera.far = distance + radius;
        }
        this.camera.updateProjectionMatrix();
        this.camera.updateMatrixWorld();
    }
}
