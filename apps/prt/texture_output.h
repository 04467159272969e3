#pragma once

#include <filesystem>
#include <string>

#include "prt/transfer/compressed_transfer.h"

namespace prt::cli {

/// Writes the transfer of vertices as RGBA textures of 8 bits (packTransferTextures) into a folder:
/// transfer-00.png, transfer-01.png, …, and textures.json, which says what their bytes stand for.
///
/// Vertex v is texel (v mod width, v div width); texels behind the last vertex repeat it.
///
/// @param transfer  with one layer, a receiver a vertex, and as checkFillsTextures demands
/// @throws Error    writeFailed
void writeTransferTextures(const std::filesystem::path& folder, const CompressedTransfer& transfer);

/// @throws Error  invalidOption for a single band, or no vertices
void checkFillsTextures(const CompressedTransfer& transfer, const std::string& asset);

}  // namespace prt::cli
