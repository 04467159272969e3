#include "prt/io/mesh_completion.h"

#include <cmath>
#include <numeric>

#include "prt/base/assert.h"
#include "prt/math/vector.h"
#include "prt/scene/normals.h"

namespace prt {
namespace {

// Ears take cubic time at worst: beyond this, a concave polygon becomes a fan too.
constexpr std::size_t kMaxEarClippingCorners = 512;

Vec3d toDouble(const Vec3f& v) {
    return Vec3d(v.x, v.y, v.z);
}

/// Twice the area, in the direction that the polygon faces.
Vec3d areaVector(std::span<const Vec3f> corners) {
    Vec3d sum(0.0);
    const Vec3d origin = toDouble(corners[0]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += (toDouble(corners[i]) - origin).cross(toDouble(corners[i + 1]) - origin);
    return sum;
}

/// Clips ears off the polygon that is left.
class EarClipper {
  public:
    EarClipper(std::span<const Vec3f> corners, const Vec3d& facing)
        : corners_(corners), facing_(facing), left_(corners.size()) {
        std::iota(left_.begin(), left_.end(), 0u);
    }

    bool isConvex() const {
        for (std::size_t i = 0; i < left_.size(); ++i)
            if (turn(before(i), left_[i], after(i)) < 0.0) return false;
        return true;
    }

    void clip(std::vector<std::uint32_t>& triangles) {
        for (std::size_t i = 1; left_.size() > 3;) {
            i = findEar(i);
            triangles.insert(triangles.end(), {before(i), left_[i], after(i)});
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
        }
        triangles.insert(triangles.end(), left_.begin(), left_.end());
    }

  private:
    std::uint32_t before(std::size_t i) const {
        return left_[(i + left_.size() - 1) % left_.size()];
    }
    std::uint32_t after(std::size_t i) const { return left_[(i + 1) % left_.size()]; }

    /// Positive where a → b → c turns as the polygon does.
    double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const Vec3d origin = toDouble(corners_[a]);
        const Vec3d toB = toDouble(corners_[b]) - origin, toC = toDouble(corners_[c]) - origin;
        return toB.cross(toC).dot(facing_);
    }

    bool isEar(std::size_t i) const {
        const std::uint32_t a = before(i), b = left_[i], c = after(i);
        if (turn(a, b, c) <= 0.0) return false;
        for (const std::uint32_t p : left_) {
            if (corners_[p] == corners_[a] || corners_[p] == corners_[b] ||
                corners_[p] == corners_[c])
                continue;
            if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
        }
        return true;
    }

    /// The next ear from corner `start` on. A polygon that crosses itself may have
    /// none: then any corner will do.
    std::size_t findEar(std::size_t start) const {
        for (std::size_t step = 0; step < left_.size(); ++step) {
            const std::size_t i = (start + step) % left_.size();
            if (isEar(i)) return i;
        }
        return start % left_.size();
    }

    std::span<const Vec3f> corners_;
    Vec3d facing_;
    std::vector<std::uint32_t> left_;
};

void appendFan(std::size_t cornerCount, std::vector<std::uint32_t>& triangles) {
    for (std::uint32_t i = 1; i + 1 < cornerCount; ++i)
        triangles.insert(triangles.end(), {0, i, i + 1});
}

}  // namespace

void triangulatePolygon(std::span<const Vec3f> corners, std::vector<std::uint32_t>& triangles) {
    PRT_ASSERT(corners.size() >= 3, "a polygon has three corners");
    if (corners.size() == 3 || corners.size() > kMaxEarClippingCorners)
        return appendFan(corners.size(), triangles);
    EarClipper clipper(corners, areaVector(corners));
    if (clipper.isConvex()) return appendFan(corners.size(), triangles);
    clipper.clip(triangles);
}

std::size_t completeNormals(Mesh& mesh) {
    if (mesh.normals.empty()) {
        computeMissingNormals(mesh);
        return 0;
    }
    std::vector<std::size_t> bad;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const Vec3d normal = toDouble(mesh.normals[i]);
        const double length = normal.length();
        const Vec3d unit = normal / length;
        mesh.normals[i] = Vec3f(float(unit.x), float(unit.y), float(unit.z));
        if (!(length > 0.0 && std::isfinite(length))) bad.push_back(i);
    }
    if (bad.empty()) return 0;

    Mesh computed;
    computed.positions = mesh.positions;
    computed.indices = mesh.indices;
    computeMissingNormals(computed);
    for (const std::size_t i : bad)
        mesh.normals[i] = computed.normals[i];
    return bad.size();
}

}  // namespace prt
