#include "apps/prt/compress_trials.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "prt/compress/choose_clusters.h"
#include "prt/relight/relighter.h"

namespace prt::cli {
namespace {

/// The fastest of some relights: what the machine can do when nothing else disturbs it.
double timeRelight(const CompressedTransfer& transfer, const Lighting& light) {
    constexpr int kRepeats = 9;
    const Relighter relighter(transfer, transfer.layers.front().transport);
    std::vector<Vec3f> radiance(relighter.receiverCount());
    double fastest = std::numeric_limits<double>::max();
    for (int i = 0; i < kRepeats; ++i) {
        const Stopwatch watch;
        relighter.relight(light, radiance);
        fastest = std::min(fastest, watch.seconds());
    }
    return fastest;
}

constexpr std::size_t kMostBases = 4096;

/// A way to store a layer, by its name and its options on the command line.
struct Candidate {
    std::string family;
    std::string words;
    CompressOptions options;
};

void addVectors(std::vector<Candidate>& candidates) {
    for (const auto& [words, encoding] :
         {std::pair{"float", TransferEncoding::float32},
          std::pair{"u16", TransferEncoding::unorm16}, std::pair{"u8", TransferEncoding::unorm8}})
        candidates.push_back(
            {"vectors", fmt::format("--method {}", words), {.encoding = encoding}});
}

/// @param clusterCount  1: PCA
void addComponents(const std::string& family, std::size_t clusterCount, TransferEncoding encoding,
                   std::size_t dimension, std::vector<Candidate>& candidates) {
    for (const std::size_t componentCount : {3u, 7u, 11u, 15u, 23u, 31u}) {
        // Of many clusters with many components, the bases outweigh what vertices store.
        const bool isHeavy = clusterCount * componentCount > kMostBases;
        if (componentCount >= dimension || isHeavy) break;
        const std::string method = clusterCount == 1
                                       ? std::string("--method pca")
                                       : fmt::format("--method cpca --clusters {}", clusterCount);
        candidates.push_back({family,
                              fmt::format("{} --components {} --weights {}", method, componentCount,
                                          encoding == TransferEncoding::unorm8 ? "u8" : "u16"),
                              {.encoding = encoding,
                               .clusters = ClusterOptions{.clusterCount = clusterCount,
                                                          .componentCount = componentCount}}});
    }
}

void addQuantisers(std::vector<Candidate>& candidates) {
    for (const std::size_t clusterCount : {16u, 64u, 256u, 1024u, 4096u}) {
        const bool isSmall = clusterCount <= largestClusterCount(TransferEncoding::unorm8);
        candidates.push_back(
            {"vector quantisation",
             fmt::format("--method vq --clusters {} --weights {}", clusterCount,
                         isSmall ? "u8" : "u16"),
             {.encoding = isSmall ? TransferEncoding::unorm8 : TransferEncoding::unorm16,
              .clusters = ClusterOptions{.clusterCount = clusterCount, .componentCount = 0}}});
    }
}

std::vector<Candidate> listCandidates(std::size_t dimension) {
    std::vector<Candidate> candidates;
    addVectors(candidates);
    addQuantisers(candidates);
    addComponents("PCA, 8 bits", 1, TransferEncoding::unorm8, dimension, candidates);
    for (const std::size_t clusterCount : {16u, 64u, 256u})
        addComponents(fmt::format("{} clusters, 8 bits", clusterCount), clusterCount,
                      TransferEncoding::unorm8, dimension, candidates);
    addComponents("64 clusters, 16 bits", 64, TransferEncoding::unorm16, dimension, candidates);
    return candidates;
}

}  // namespace

CompressionTrial judgeCompression(const CompressedTransfer& original,
                                  const CompressedTransfer& compressed, const Lighting& light) {
    const CompressedLayer& layer = compressed.layers.front();
    return {.bytes = countBytesPerReceiver(layer),
            .sharedBytes = sharedBytesPerReceiver(layer),
            .error = measureCompressionError(layer, original.layers.front(), light.coefficients),
            .relightSeconds = timeRelight(compressed, light)};
}

std::vector<CompressionTrial> tryCompressions(const CompressedTransfer& original,
                                              const Lighting& light, const CompressOptions& common,
                                              StageLog& log) {
    const std::vector<Candidate> candidates =
        listCandidates(coefficientsPerReceiver(original.bandCount, original.layers.front()));
    const Stopwatch watch;
    std::vector<CompressionTrial> trials;
    const ProgressCallback progress = log.callback();
    for (const Candidate& candidate : candidates) {
        CompressOptions options = candidate.options;
        options.threadCount = common.threadCount;
        options.progress = [&](const Progress&) {
            return progress({"try", "methods", trials.size(), candidates.size()});
        };
        if (options.clusters && common.clusters) {
            options.clusters->seed = common.clusters->seed;
            options.clusters->light = common.clusters->light;
        }
        const Stopwatch compress;
        const CompressedTransfer compressed = compressTransfer(expandTransfer(original), options);
        const double seconds = compress.seconds();
        trials.push_back(judgeCompression(original, compressed, light));
        trials.back().family = candidate.family;
        trials.back().options = candidate.words;
        trials.back().compressSeconds = seconds;
    }
    log.finishStage("try", watch.seconds(), fmt::format("{} methods", candidates.size()));
    return trials;
}

}  // namespace prt::cli
