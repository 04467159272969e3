import { type Box3, MathUtils, Vector3 } from 'three';

import type { View } from '../page_data.js';

const kFovDegrees = 40;
const kAspectRatio = 16 / 9;
const kMargin = 1.05;

// From the target to the eye: a little to the right and above.
const kDirection = new Vector3(0.45, 0.4, 1).normalize();

/** A view of all of a box, as prt chooses it: back until the last of the eight corners is in view. */
export function frameBounds(box: Box3): View {
    const center = box.getCenter(new Vector3());
    const half = box.getSize(new Vector3()).multiplyScalar(0.5);
    const forward = kDirection.clone().negate();
    const right = forward.clone().cross(new Vector3(0, 1, 0)).normalize();
    const up = right.clone().cross(forward);
    const tangent = Math.tan(MathUtils.degToRad(kFovDegrees) / 2);
    let distance = 0;
    for (let corner = 0; corner < 8; ++corner) {
        const point = new Vector3(corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z);
        const sideways = Math.abs(point.dot(right)) / (tangent * kAspectRatio);
        const upwards = Math.abs(point.dot(up)) / tangent;
        distance = Math.max(distance, Math.max(sideways, upwards) - point.dot(forward));
    }
    const eye = center.addScaledVector(kDirection, (distance > 0 ? distance : 1) * kMargin);
    return { eye: eye.toArray(), forward: forward.toArray(), verticalFovDegrees: kFovDegrees };
}
