#pragma once

#include <filesystem>

namespace prt::cli {

/// A folder that appears whole or not at all: filled under a temporary name beside its own, then
/// renamed.
class StagedFolder {
  public:
    /// Checks that the folder can be made, so that long work does not fail at its end.
    ///
    /// @throws Error  invalidOption if something is there already (an empty folder may be);
    ///                writeFailed if nothing can be created there
    static void check(const std::filesystem::path& folder);

    /// @throws Error  as check
    explicit StagedFolder(std::filesystem::path folder);
    ~StagedFolder();  ///< removes what was not committed
    StagedFolder(const StagedFolder&) = delete;
    StagedFolder& operator=(const StagedFolder&) = delete;

    /// Where to write the files.
    const std::filesystem::path& path() const { return staging_; }

    /// Gives it its name. @throws Error writeFailed
    void commit();

  private:
    std::filesystem::path folder_;
    std::filesystem::path staging_;
};

}  // namespace prt::cli
