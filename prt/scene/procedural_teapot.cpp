#include <algorithm>
#include <array>
#include <initializer_list>
#include <span>
#include <utility>
#include <vector>

#include "prt/base/assert.h"
#include "prt/scene/mesh_building.h"
#include "prt/scene/procedural.h"

// [Newell75] M. Newell: The Utilization of Procedure Models in Digital Image Synthesis, 1975. His
// 306 control points of 32 bicubic patches follow from fewer numbers: body and lid are profiles
// turned by four quarter circles, handle and spout have a mirrored half each. Newell's axes are x
// to the spout, z up; ours have y up.

namespace prt {
namespace {

// The control points of a tube of patches: rows along it, columns around
// it, the last joining the first.
struct ControlNet {
    int columnCount = 0;
    int rowCount = 0;
    std::vector<Vec3d> points{};

    const Vec3d& at(int row, int column) const {
        return points[static_cast<std::size_t>(row * columnCount + column % columnCount)];
    }
    // Points in Newell's axes.
    void addRow(std::initializer_list<Vec3d> row) {
        for (const Vec3d& point : row)
            points.emplace_back(point.x, point.z, -point.y);
        ++rowCount;
    }
};

// A point of a profile, and how far along the tangent the quarter circle through
// it has its inner control point.
struct ProfilePoint {
    double radius;
    double tangent;
    double height;
};

// A cross-section of the handle or the spout: a bar from (innerX, innerZ) to (outerX, outerZ),
// rounded to the sides.
struct Section {
    double innerX;
    double innerZ;
    double outerX;
    double outerZ;
    double halfWidth;
};

// Rim, upper body, lower body, bottom.
constexpr std::array<ProfilePoint, 13> kBody{{{1.4, 0.784, 2.4},
                                              {1.3375, 0.749, 2.53125},
                                              {1.4375, 0.805, 2.53125},
                                              {1.5, 0.84, 2.4},
                                              {1.75, 0.98, 1.875},
                                              {2.0, 1.12, 1.35},
                                              {2.0, 1.12, 0.9},
                                              {2.0, 1.12, 0.45},
                                              {1.5, 0.84, 0.225},
                                              {1.5, 0.84, 0.15},
                                              {1.5, 0.84, 0.075},
                                              {1.425, 0.798, 0.0},
                                              {0.0, 0.0, 0.0}}};

// Knob, lid.
constexpr std::array<ProfilePoint, 7> kLid{{{0.0, 0.0, 3.15},
                                            {0.8, 0.45, 3.15},
                                            {0.0, 0.0, 2.85},
                                            {0.2, 0.112, 2.7},
                                            {0.4, 0.224, 2.55},
                                            {1.3, 0.728, 2.55},
                                            {1.3, 0.728, 2.4}}};

constexpr std::array<Section, 7> kHandle{{{-1.6, 2.025, -1.5, 2.25, 0.3},
                                          {-2.3, 2.025, -2.5, 2.25, 0.3},
                                          {-2.7, 2.025, -3.0, 2.25, 0.3},
                                          {-2.7, 1.8, -3.0, 1.8, 0.3},
                                          {-2.7, 1.575, -3.0, 1.35, 0.3},
                                          {-2.5, 1.125, -2.65, 0.9375, 0.3},
                                          {-2.0, 0.9, -1.9, 0.6, 0.3}}};

constexpr std::array<Section, 7> kSpout{{{1.7, 1.425, 1.7, 0.6, 0.66},
                                         {2.6, 1.425, 3.1, 0.825, 0.66},
                                         {2.3, 2.1, 2.4, 2.025, 0.25},
                                         {2.7, 2.4, 3.3, 2.4, 0.25},
                                         {2.8, 2.475, 3.525, 2.49375, 0.25},
                                         {2.9, 2.475, 3.45, 2.5125, 0.15},
                                         {2.8, 2.4, 3.2, 2.4, 0.15}}};

// 2 over the width of the surface, which ends at x = -3 in the handle and in the spout's tip at t =
// (12 - sqrt(99)) / 5 of the cubic 3.3, 3.525, 3.45, 3.2.
constexpr double kMetresPerUnit = 0.31084498719675092;

ControlNet turnProfile(std::span<const ProfilePoint> profile) {
    ControlNet net{.columnCount = 12};
    for (const auto& [r, t, z] : profile) {
        net.addRow({{r, 0.0, z},
                    {r, -t, z},
                    {t, -r, z},
                    {0.0, -r, z},
                    {-t, -r, z},
                    {-r, -t, z},
                    {-r, 0.0, z},
                    {-r, t, z},
                    {-t, r, z},
                    {0.0, r, z},
                    {t, r, z},
                    {r, t, z}});
    }
    return net;
}

ControlNet mirrorSections(std::span<const Section> sections) {
    ControlNet net{.columnCount = 6};
    for (const auto& [innerX, innerZ, outerX, outerZ, w] : sections) {
        net.addRow({{innerX, 0.0, innerZ},
                    {innerX, -w, innerZ},
                    {outerX, -w, outerZ},
                    {outerX, 0.0, outerZ},
                    {outerX, w, outerZ},
                    {innerX, w, innerZ}});
    }
    return net;
}

// Bernstein's cubics and their derivatives at i/n.
struct CubicWeights {
    std::array<double, 4> value;
    std::array<double, 4> slope;

    CubicWeights(int i, int n) {
        const double t = static_cast<double>(i) / n;
        const double s = static_cast<double>(n - i) / n;
        value = {s * s * s, 3.0 * (s * t) * s, 3.0 * (s * t) * t, t * t * t};
        slope = {-3.0 * s * s, 3.0 * s * (s - 2.0 * t), 3.0 * t * (2.0 * s - t), 3.0 * t * t};
    }
};

Vec3d blend(const ControlNet& net, int firstRow, int firstColumn,
            const std::array<double, 4>& rowWeights, const std::array<double, 4>& columnWeights) {
    Vec3d sum(0.0);
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) {
            sum += net.at(firstRow + row, firstColumn + column) *
                   (rowWeights[static_cast<std::size_t>(row)] *
                    columnWeights[static_cast<std::size_t>(column)]);
        }
    }
    return sum;
}

// The grid of vertices over a net's patches, which share the vertices of their common edges.
class TubeGrid {
  public:
    TubeGrid(const ControlNet& net, int patchCellCount)
        : net_(net),
          cells_(patchCellCount),
          rowCount_((net.rowCount - 1) / 3 * cells_),
          columnCount_(net.columnCount / 3 * cells_) {}

    Mesh makeMesh() {
        for (int row = 0; row <= rowCount_; ++row) {
            rowStarts_.push_back(static_cast<std::uint32_t>(mesh_.vertexCount()));
            const int vertexCount = isPole(row) ? 1 : columnCount_;
            for (int column = 0; column < vertexCount; ++column)
                addVertex(row, column);
        }
        for (int row = 0; row < rowCount_; ++row) {
            for (int column = 0; column < columnCount_; ++column)
                addCell(row, column);
        }
        return std::move(mesh_);
    }

  private:
    // Whether a profile meets the axis at that end.
    bool isPole(int row) const {
        if (row != 0 && row != rowCount_) return false;
        const int netRow = row == 0 ? 0 : net_.rowCount - 1;
        return net_.at(netRow, 0) == net_.at(netRow, net_.columnCount / 2);
    }

    void addVertex(int row, int column) {
        const int firstRow = std::min(row / cells_ * 3, net_.rowCount - 4);
        const int firstColumn = column / cells_ * 3;
        const CubicWeights along(row - firstRow / 3 * cells_, cells_);
        const CubicWeights around(column % cells_, cells_);
        const Vec3d position = blend(net_, firstRow, firstColumn, along.value, around.value);
        const Vec3d tangentAlong = blend(net_, firstRow, firstColumn, along.slope, around.value);
        const Vec3d tangentAround = blend(net_, firstRow, firstColumn, along.value, around.slope);

        // Profiles leave the axis at a right angle, so at a pole the normal is the axis.
        const Vec3d normal = isPole(row) ? Vec3d(0.0, row == 0 ? 1.0 : -1.0, 0.0)
                                         : tangentAround.cross(tangentAlong).normalized();
        mesh_.positions.push_back(Vec3f(position * kMetresPerUnit));
        mesh_.normals.push_back(Vec3f(normal));
    }

    void addCell(int row, int column) {
        const std::uint32_t a = vertexAt(row, column), b = vertexAt(row, column + 1);
        const std::uint32_t c = vertexAt(row + 1, column + 1), d = vertexAt(row + 1, column);
        if (a != b) mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
        if (c != d) mesh_.indices.insert(mesh_.indices.end(), {a, c, d});
    }

    std::uint32_t vertexAt(int row, int column) const {
        return rowStarts_[static_cast<std::size_t>(row)] +
               (isPole(row) ? 0u : static_cast<std::uint32_t>(column % columnCount_));
    }

    const ControlNet& net_;
    int cells_;
    int rowCount_;     // of cells
    int columnCount_;  // of cells and of vertices
    Mesh mesh_;
    std::vector<std::uint32_t> rowStarts_;
};

}  // namespace

Mesh makeTeapot(int patchCellCount) {
    PRT_ASSERT(patchCellCount >= 2, "the handle is round");
    Mesh teapot;
    teapot.name = "teapot";
    for (const ControlNet& net :
         {turnProfile(kBody), turnProfile(kLid), mirrorSections(kHandle), mirrorSections(kSpout)}) {
        appendMesh(teapot, TubeGrid(net, patchCellCount).makeMesh());
    }
    return teapot;
}

}  // namespace prt
