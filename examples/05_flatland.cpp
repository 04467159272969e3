// Radiance transfer in flatland, where all of it fits on a page: directions are angles, light and
// transfer are functions on a circle, and the basis is piecewise constant,
//
//   y_k(ω) = √(m/2π) on [2πk/m, 2π(k+1)/m), 0 elsewhere                          [Dachsbacher17]
//
// A floor beside a red wall is lit by a narrow sun. Each receiver projects its transfer, visibility
// times cosine and one bounce, once; then light is a dot product. Rows of the picture are positions
// of the sun, columns places on the floor, the wall at the left. From the top: without shadows,
// with them, with a bounce, all in 32 functions; and the last again in 512, close to the truth.
//
//   05_flatland OUT.png

#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <vector>

#include "prt/base/error.h"
#include "prt/image/tone_curve.h"
#include "prt/io/image_io.h"

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kRowCount = 96;        // positions of the sun, a row each
constexpr int kReceiverCount = 384;  // on the floor; as many on the wall
constexpr double kWallHeight = 1.0, kFloorWidth = 3.0, kSunHalfAngle = 0.12;

/// A point of the scene, and the direction that its surface faces.
struct Receiver {
    double x, y;
    double normalAngle;
    prt::Vec3d albedo;
};

/// The floor runs along +x from the origin, the wall up along +y.
std::vector<Receiver> makeReceivers() {
    std::vector<Receiver> floor, wall;
    for (int i = 0; i < kReceiverCount; ++i) {
        const double t = (i + 0.5) / kReceiverCount;
        floor.push_back({kFloorWidth * t, 0.0, 0.5 * kPi, {0.8, 0.8, 0.8}});
        wall.push_back({0.0, kWallHeight * t, 0.0, {0.8, 0.15, 0.1}});
    }
    floor.insert(floor.end(), wall.begin(), wall.end());
    return floor;
}

/// The receiver that a ray from another meets, if any.
std::optional<std::size_t> findHit(const Receiver& from, double angle) {
    const double dx = std::cos(angle), dy = std::sin(angle);
    if (from.x > 0.0 && dx < 0.0) {  // from the floor to the wall
        const double height = -from.x / dx * dy;
        if (height >= 0.0 && height < kWallHeight)
            return kReceiverCount + static_cast<std::size_t>(height / kWallHeight * kReceiverCount);
    } else if (from.x == 0.0 && dy < 0.0 && dx > 0.0) {  // from the wall to the floor
        const double distance = -from.y / dy * dx;
        if (distance < kFloorWidth)
            return static_cast<std::size_t>(distance / kFloorWidth * kReceiverCount);
    }
    return std::nullopt;
}

/// A function on the circle, or what is left of one: m numbers for red, green and blue.
using Coefficients = std::vector<prt::Vec3d>;

/// One vector a receiver: without shadows, with them, and with one bounce.
struct Transfer {
    std::vector<Coefficients> unshadowed, shadowed, bounced;
};

/// In flatland a cosine integrates to 2, which takes the place of π.
Transfer bakeTransfer(const std::vector<Receiver>& receivers, int functionCount) {
    constexpr int kRaysPerFunction = 16;
    const int rayCount = kRaysPerFunction * functionCount;
    const double height = std::sqrt(functionCount / (2.0 * kPi));
    const auto forEachRay = [&](const Receiver& receiver, const auto& take) {
        for (int ray = 0; ray < rayCount; ++ray) {
            const double angle = 2.0 * kPi * (ray + 0.5) / rayCount;
            const double cosine = std::cos(angle - receiver.normalAngle);
            if (cosine > 0.0)
                take(static_cast<std::size_t>(ray / kRaysPerFunction),
                     0.5 * cosine * 2.0 * kPi / rayCount, findHit(receiver, angle));
        }
    };
    const std::vector<Coefficients> none(
        receivers.size(), Coefficients(static_cast<std::size_t>(functionCount), prt::Vec3d(0.0)));
    Transfer transfer{none, none, {}};
    for (std::size_t x = 0; x < receivers.size(); ++x)
        forEachRay(receivers[x], [&](std::size_t k, double weight, std::optional<std::size_t> hit) {
            transfer.unshadowed[x][k] += prt::Vec3d(weight * height);
            if (!hit) transfer.shadowed[x][k] += prt::Vec3d(weight * height);
        });
    transfer.bounced = transfer.shadowed;
    for (std::size_t x = 0; x < receivers.size(); ++x)
        forEachRay(receivers[x], [&](std::size_t, double weight, std::optional<std::size_t> hit) {
            for (std::size_t k = 0; hit && k < none[x].size(); ++k)
                transfer.bounced[x][k] +=
                    receivers[*hit].albedo * transfer.shadowed[*hit][k] * weight;
        });
    return transfer;
}

/// A warm sun that gives a facing surface about 1, and a faint blue sky, projected.
Coefficients projectLight(double sunAngle, int functionCount) {
    constexpr int kSampleCount = 4096;
    const double height = std::sqrt(functionCount / (2.0 * kPi));
    Coefficients light(static_cast<std::size_t>(functionCount), prt::Vec3d(0.0));
    for (int i = 0; i < kSampleCount; ++i) {
        const double angle = 2.0 * kPi * (i + 0.5) / kSampleCount;
        prt::Vec3d radiance = prt::Vec3d(0.03, 0.05, 0.09) * (angle < kPi ? 1.0 : 0.0);
        if (std::abs(angle - sunAngle) < kSunHalfAngle) radiance += prt::Vec3d(8.0, 7.5, 6.5);
        light[static_cast<std::size_t>(i * functionCount / kSampleCount)] +=
            radiance * (height * 2.0 * kPi / kSampleCount);
    }
    return light;
}

/// Rows of suns over columns of places, under one kind of transfer.
void drawBand(const std::vector<Receiver>& receivers, const std::vector<Coefficients>& transfer,
              prt::Image& picture) {
    for (int row = 0; row < kRowCount; ++row) {
        const double sunAngle = kPi * (row + 0.5) / kRowCount;
        const Coefficients light = projectLight(sunAngle, static_cast<int>(transfer[0].size()));
        for (std::size_t x = 0; x < kReceiverCount; ++x) {
            prt::Vec3d radiance(0.0);
            for (std::size_t k = 0; k < light.size(); ++k)
                radiance += transfer[x][k] * light[k];
            picture.pixels.emplace_back(receivers[x].albedo * radiance);
        }
    }
    picture.height += kRowCount;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) return std::fprintf(stderr, "usage: %s OUT.png\n", argv[0]), 2;
    try {
        const std::vector<Receiver> receivers = makeReceivers();
        const Transfer transfer = bakeTransfer(receivers, 32);
        const Transfer fine = bakeTransfer(receivers, 512);
        prt::Image picture(kReceiverCount, 0);
        for (const auto& kind : {transfer.unshadowed, transfer.shadowed, transfer.bounced})
            drawBand(receivers, kind, picture);
        drawBand(receivers, fine.bounced, picture);
        prt::writePng(argv[1], prt::encodeForDisplay(picture, {.exposureStops = -0.7f}));
        return 0;
    } catch (const prt::Error& error) {
        std::fprintf(stderr, "%s\n", error.message().c_str());
        return 1;
    }
}
