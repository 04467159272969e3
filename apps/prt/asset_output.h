#pragma once

#include <string>

namespace prt::cli {

/// @param sourceWords  what the source is: "the scene it is baked from"
/// @throws Error       invalidOption if the output is the file that it is made from
void refuseOverwriting(const std::string& output, const std::string& source,
                       const std::string& sourceWords, const std::string& hint);

/// Checks that an asset can be written, so that long work does not fail at its end.
///
/// @param source       the file that it is made from, which must not be overwritten
/// @param sourceWords  what that is: "the scene it is baked from"
/// @throws Error       invalidOption for another suffix than .glb, or the source itself;
/// writeFailed
void checkAssetOutput(const std::string& output, const std::string& source,
                      const std::string& sourceWords);

}  // namespace prt::cli
