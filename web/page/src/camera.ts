import type { Vec3 } from 'openprt-three';
import { MathUtils, PerspectiveCamera, type Sphere, Vector3 } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

import type { LoadedAsset } from './load_asset.js';

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

    /** Where pictures are higher than wide the field of view is that of the width, so that what was in view stays in view. */
    setAspectRatio(aspectRatio: number): void {
        const tangent = Math.tan(MathUtils.degToRad(this.verticalFovDegrees) / 2) / Math.min(aspectRatio, 1);
        this.camera.aspect = aspectRatio;
        this.camera.fov = MathUtils.radToDeg(2 * Math.atan(tangent));
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
