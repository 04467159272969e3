#pragma once

#include <Imath/ImathMatrix.h>
#include <Imath/ImathQuat.h>

#include "prt/math/vector.h"

namespace prt {

/// A 3×3 matrix that acts on column vectors: matrix[row][column], `matrix * vector` (C9).
///
/// Imath's own `vector * matrix` treats vectors as rows and must not be used with it.
using Mat3d = Imath::M33d;

Vec3d operator*(const Mat3d& matrix, const Vec3d& vector);
Vec3f operator*(const Mat3d& matrix, const Vec3f& vector);

/// Active right-handed rotations about the axes: rotationZ(π/2) takes +x to +y.
Mat3d rotationX(double angleRadians);
Mat3d rotationY(double angleRadians);
Mat3d rotationZ(double angleRadians);

/// Active right-handed rotation about a unit axis.
Mat3d rotationAbout(const Vec3d& axis, double angleRadians);

/// The rotation of a unit quaternion, r = cos(θ/2) and v = sin(θ/2) · axis, as rotationAbout gives
/// it; q and −q are the same. (Imath's own toMatrix33 is its transpose, for row vectors.)
Mat3d rotationFromQuaternion(const Imath::Quatd& quaternion);

/// An affine map p ↦ linear·p + translation, named destinationFromSource
/// and chained left to right (C9).
struct Affine3d {
    Mat3d linear;  ///< identity by default
    Vec3d translation{0.0, 0.0, 0.0};
};

Affine3d operator*(const Affine3d& outer, const Affine3d& inner);
Vec3d transformPoint(const Affine3d& map, const Vec3d& point);

/// The matrix that takes normals with `linear`: its cofactors, which equal
/// det(linear) times the inverse transpose, so a mirrored instance keeps its outside
/// outside. The result is not normalised.
Mat3d normalMatrix(const Mat3d& linear);

}  // namespace prt
