#pragma once

#include <cmath>

#include "prt/math/vector.h"

namespace prt {

/// A right-handed orthonormal frame: tangent × bitangent = normal.
template <class Real>
struct Frame {
    Imath::Vec3<Real> tangent;
    Imath::Vec3<Real> bitangent;
    Imath::Vec3<Real> normal;

    /// From coordinates along tangent, bitangent and normal to the world.
    Imath::Vec3<Real> worldFromLocal(const Imath::Vec3<Real>& local) const {
        return tangent * local.x + bitangent * local.y + normal * local.z;
    }

    /// And back.
    Imath::Vec3<Real> localFromWorld(const Imath::Vec3<Real>& world) const {
        return {world.dot(tangent), world.dot(bitangent), world.dot(normal)};
    }
};

/// Completes a unit normal to a frame, without branches and continuous but at normal.z = 0
/// [Duff17].
template <class Real>
Frame<Real> frameFromNormal(const Imath::Vec3<Real>& normal) {
    const Real sign = std::copysign(Real(1), normal.z);
    const Real a = Real(-1) / (sign + normal.z);
    const Real b = normal.x * normal.y * a;
    return {{Real(1) + sign * normal.x * normal.x * a, sign * b, -sign * normal.x},
            {b, sign + normal.y * normal.y * a, -normal.y},
            normal};
}

}  // namespace prt
