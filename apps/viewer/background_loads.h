#pragma once

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/viewer/loading.h"
#include "prt/base/error.h"

namespace prt::viewer {

/// Reads things by their names on a thread of its own, in the order in which they were asked for.
/// All other calls come from one thread.
template <class Value>
class BackgroundLoads {
  public:
    struct Loaded {
        Value value;
        std::string message{};  ///< what had to be mended
    };
    /// Called on that thread. What it throws is the status of its name, and disturbs no other.
    using Read = std::function<Loaded(const std::string& name)>;

    struct Entry {
        LoadingStatus status{};
        std::shared_ptr<const Value> value{};  ///< null until it is ready
    };

    explicit BackgroundLoads(Read read)
        : read_(std::move(read)), thread_([this] { readWhatIsWanted(); }) {}
    BackgroundLoads(const BackgroundLoads&) = delete;
    BackgroundLoads& operator=(const BackgroundLoads&) = delete;

    /// Waits for no more than what is being read.
    ~BackgroundLoads() {
        {
            const std::lock_guard lock(mutex_);
            isStopping_ = true;
        }
        changed_.notify_all();
        thread_.join();
    }

    /// Takes over what has been read, asks for the names that are new, and forgets all others.
    void update(std::span<const std::string> names) {
        const auto isForgotten = [&](const std::string& name) {
            return std::find(names.begin(), names.end(), name) == names.end();
        };
        takeOver();
        if (std::equal(names.begin(), names.end(), names_.begin(), names_.end())) return;
        names_.assign(names.begin(), names.end());
        std::erase_if(entries_, [&](const auto& entry) { return isForgotten(entry.first); });
        {
            const std::lock_guard lock(mutex_);
            std::erase_if(wanted_, isForgotten);
            for (const std::string& name : names)
                if (entries_.try_emplace(name).second && name != isBeingRead_)
                    wanted_.push_back(name);
        }
        changed_.notify_all();
    }

    /// The same, and waits until all is read.
    void finish(std::span<const std::string> names) {
        update(names);
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return wanted_.empty() && !isBeingRead_; });
        }
        takeOver();
    }

    /// @param name  one of the last update
    const Entry& at(const std::string& name) const { return entries_.at(name); }

  private:
    void takeOver() {
        std::vector<std::pair<std::string, Entry>> read;
        {
            const std::lock_guard lock(mutex_);
            read.swap(hasBeenRead_);
        }
        for (auto& [name, entry] : read)
            if (const auto known = entries_.find(name);
                known != entries_.end() &&
                known->second.status.stage == LoadingStatus::Stage::waiting)
                known->second = std::move(entry);
    }

    void readWhatIsWanted() {
        std::unique_lock lock(mutex_);
        while (true) {
            changed_.wait(lock, [&] { return isStopping_ || !wanted_.empty(); });
            if (isStopping_) return;
            const std::string name = std::move(wanted_.front());
            wanted_.pop_front();
            isBeingRead_ = name;
            lock.unlock();
            Entry entry = tryToRead(name);
            lock.lock();
            hasBeenRead_.emplace_back(name, std::move(entry));
            isBeingRead_.reset();
            changed_.notify_all();
        }
    }

    Entry tryToRead(const std::string& name) const {
        try {
            Loaded loaded = read_(name);
            return {{LoadingStatus::Stage::ready, std::move(loaded.message)},
                    std::make_shared<const Value>(std::move(loaded.value))};
        } catch (const Error& error) {
            return {{LoadingStatus::Stage::failed, error.message()}, nullptr};
        } catch (const std::bad_alloc&) {
            return {{LoadingStatus::Stage::failed, name + ": does not fit in memory"}, nullptr};
        } catch (const std::exception& failure) {
            return {{LoadingStatus::Stage::failed, name + ": " + failure.what()}, nullptr};
        }
    }

    const Read read_;
    std::vector<std::string> names_;        ///< of the last update
    std::map<std::string, Entry> entries_;  ///< of them

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::string> wanted_;
    std::optional<std::string> isBeingRead_;
    std::vector<std::pair<std::string, Entry>> hasBeenRead_;
    bool isStopping_ = false;

    std::thread thread_;  ///< last, when all else stands
};

}  // namespace prt::viewer
