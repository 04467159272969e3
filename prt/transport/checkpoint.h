#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace prt {

/// A choice that decides the result of long work, as text: {"samples", "1024"}.
struct Setting {
    std::string name;
    std::string value;
    bool operator==(const Setting&) const = default;
};

/// Which piece of the work a unit file holds: items [begin, end) of a stage.
struct UnitKey {
    std::string stage;  ///< at most kMaxStageBytes of a-z, 0-9 and "-": it names the file
    std::uint32_t index = 0;
    std::uint64_t begin = 0;
    std::uint64_t end = 0;
};

inline constexpr std::size_t kMaxStageBytes = 16;

/// A unit file: the key, the work it belongs to, the payload, and a CRC-32 over all of it.
std::vector<std::byte> encodeUnit(std::uint64_t workFingerprint, const UnitKey& key,
                                  std::span<const std::byte> payload);

/// Checks every byte of a unit file.
///
/// @return        the payload, a part of `bytes`
/// @throws Error  malformed if the bytes are not whole, or are another unit's or another work's
std::span<const std::byte> readUnit(std::span<const std::byte> bytes, std::uint64_t workFingerprint,
                                    const UnitKey& key);

/// The settings of a work as JSON, in their order.
std::string encodeManifest(std::span<const Setting> settings);

/// @throws Error  malformed, or unsupported for a version to come
std::vector<Setting> readManifest(std::span<const std::byte> bytes);

/// The settings of the work that a folder was begun with.
///
/// @throws Error  notFound if the folder holds no work; as readManifest, or unreadable
std::vector<Setting> readFolderSettings(const std::filesystem::path& folder);

/// Keeps the finished units of long work in a folder, so that work that was killed goes on where it
/// was. It knows nothing of what the work is.
///
/// Each unit is a file that appears whole or not at all (writeFileAtomically). Many processes may
/// work in one folder: they make the same bytes. All methods may be called from many threads.
class Checkpoint {
  public:
    /// Begins the work in a new or empty folder, or takes up the same work.
    ///
    /// @param folder        made if missing; units are written here
    /// @param otherFolders  units are read from these too; they must hold the same work
    /// @throws Error        invalidOption naming the settings that differ from those the folder was
    ///                      begun with, or for a folder of other files; writeFailed; as
    ///                      readFolderSettings
    Checkpoint(const std::filesystem::path& folder,
               const std::vector<std::filesystem::path>& otherFolders,
               const std::vector<Setting>& settings);
    ~Checkpoint();
    Checkpoint(const Checkpoint&) = delete;
    Checkpoint& operator=(const Checkpoint&) = delete;

    /// Finds a unit that is whole and passes its payload to `parse`, whose Error{malformed} counts
    /// as damage too. A damaged file is left out, with a warning.
    ///
    /// @return  whether one was found
    bool load(const UnitKey& key,
              const std::function<void(std::span<const std::byte> payload)>& parse);

    /// Whether there is a file for the unit, whole or not.
    bool contains(const UnitKey& key) const;

    /// @throws Error  writeFailed
    void store(const UnitKey& key, std::span<const std::byte> payload);

    const std::filesystem::path& folder() const { return folders_.front(); }

    /// What was found damaged, one sentence each, by name.
    std::vector<std::string> warnings() const;

  private:
    class Presence;

    std::vector<std::filesystem::path> folders_;  // the first is written to
    std::uint64_t workFingerprint_;
    std::unique_ptr<Presence> presence_;
    mutable std::mutex warning_;
    std::vector<std::string> warnings_;
};

}  // namespace prt
