#pragma once

#include <string>
#include <vector>

#include "apps/prt/stage_log.h"
#include "prt/asset/asset.h"
#include "prt/io/image_io.h"
#include "prt/light/lighting.h"

namespace prt::cli {

/// Reads an asset that can be shown: with triangles, textures decoded, its warnings passed on.
///
/// @param limits  of its textures
Asset readPreparedAsset(const std::string& path, const ImageLimits& limits, StageLog& log);

/// The last of the layers that it was baked with.
Transport fullestTransport(const CompressedTransfer& transfer);

/// Relights one layer: B of every vertex of the scene (C7). The unshadowed layer follows from the
/// normals, so every asset can show it; the others must have been baked.
///
/// @param path    how to call the asset in an error
/// @throws Error  invalidOption for a layer that it lacks
std::vector<Vec3f> relightVertices(const Asset& asset, const std::string& path, Transport transport,
                                   const Lighting& lighting);

/// The least smoothing of a light under which no vertex reflects negative light, one factor a band.
///
/// @param lighting  turned as it will be
/// @throws Error    as relightVertices
std::vector<double> deringForAsset(const Asset& asset, const std::string& path, Transport transport,
                                   const Lighting& lighting);

}  // namespace prt::cli
