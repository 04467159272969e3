#include "prt/math/transform.h"

#include <cmath>

namespace prt {
namespace {

template <class Real>
Imath::Vec3<Real> multiply(const Mat3d& matrix, const Imath::Vec3<Real>& vector) {
    Imath::Vec3<Real> product;
    for (int row = 0; row < 3; ++row) {
        const double* m = matrix[row];
        product[row] = static_cast<Real>(m[0] * vector.x + m[1] * vector.y + m[2] * vector.z);
    }
    return product;
}

}  // namespace

Vec3d operator*(const Mat3d& matrix, const Vec3d& vector) {
    return multiply(matrix, vector);
}

Vec3f operator*(const Mat3d& matrix, const Vec3f& vector) {
    return multiply(matrix, vector);
}

Mat3d rotationX(double angleRadians) {
    return rotationAbout(Vec3d(1.0, 0.0, 0.0), angleRadians);
}

Mat3d rotationY(double angleRadians) {
    return rotationAbout(Vec3d(0.0, 1.0, 0.0), angleRadians);
}

Mat3d rotationZ(double angleRadians) {
    return rotationAbout(Vec3d(0.0, 0.0, 1.0), angleRadians);
}

Mat3d rotationAbout(const Vec3d& axis, double angleRadians) {
    const double x = axis.x, y = axis.y, z = axis.z;
    const double c = std::cos(angleRadians);
    const double s = std::sin(angleRadians);
    const double t = 1.0 - c;
    return Mat3d(t * x * x + c, t * x * y - s * z, t * x * z + s * y,  //
                 t * x * y + s * z, t * y * y + c, t * y * z - s * x,  //
                 t * x * z - s * y, t * y * z + s * x, t * z * z + c);
}

Mat3d rotationFromQuaternion(const Imath::Quatd& quaternion) {
    return quaternion.toMatrix33().transposed();
}

Affine3d operator*(const Affine3d& outer, const Affine3d& inner) {
    return {outer.linear * inner.linear, transformPoint(outer, inner.translation)};
}

Vec3d transformPoint(const Affine3d& map, const Vec3d& point) {
    return map.linear * point + map.translation;
}

Mat3d normalMatrix(const Mat3d& linear) {
    // Row i of the cofactor matrix is the cross product of the two rows that follow row i.
    const Vec3d a(linear[0][0], linear[0][1], linear[0][2]);
    const Vec3d b(linear[1][0], linear[1][1], linear[1][2]);
    const Vec3d c(linear[2][0], linear[2][1], linear[2][2]);
    const Vec3d bc = b.cross(c), ca = c.cross(a), ab = a.cross(b);
    return Mat3d(bc.x, bc.y, bc.z, ca.x, ca.y, ca.z, ab.x, ab.y, ab.z);
}

}  // namespace prt
