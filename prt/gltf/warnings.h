#pragma once

#include <string>
#include <unordered_set>
#include <vector>

namespace prt::gltf {

/// What a reader mended or left out, each sentence once, in order.
class Warnings {
  public:
    void add(const std::string& sentence) {
        if (known_.insert(sentence).second) sentences_.push_back(sentence);
    }
    const std::vector<std::string>& sentences() const { return sentences_; }

  private:
    std::unordered_set<std::string> known_;
    std::vector<std::string> sentences_;
};

}  // namespace prt::gltf
