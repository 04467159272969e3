#pragma once

#include <cstdint>

namespace prt {

/// Mixes 64 bits so that every input bit changes every output bit with probability near one half
/// [Steele14, the finaliser of SplitMix64].
constexpr std::uint64_t mixBits(std::uint64_t bits) {
    bits += 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
}

/// A counter-based stream of random numbers: the i-th number depends on the key and i alone, never
/// on the thread that asks, so the same seed gives the same bits (C10).
class RandomStream {
  public:
    /// @param seed    the user's seed
    /// @param stream  which of the independent streams of that seed: a receiver, a pixel
    constexpr RandomStream(std::uint64_t seed, std::uint64_t stream)
        : key_(mixBits(mixBits(seed) ^ stream)) {}

    constexpr std::uint32_t nextBits() {
        return static_cast<std::uint32_t>(mixBits(key_ + counter_++) >> 32);
    }

    /// Uniform in [0, 1).
    constexpr float nextUnitFloat() { return static_cast<float>(nextBits() >> 8) * 0x1p-24f; }
    constexpr double nextUnitDouble() {
        const std::uint64_t high = nextBits();
        return static_cast<double>((high << 21) ^ (nextBits() >> 11)) * 0x1p-53;
    }

  private:
    std::uint64_t key_;
    std::uint64_t counter_ = 0;
};

}  // namespace prt
