#include "prt/compress/choose_clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "prt/base/assert.h"
#include "prt/base/error.h"
#include "prt/compress/compression_error.h"
#include "prt/compress/light_error_weights.h"
#include "prt/compress/lloyd.h"
#include "prt/compress/quantise_table.h"
#include "prt/compress/table_rows.h"

namespace prt {
namespace {

constexpr std::size_t kMostClusters = 256;
constexpr std::size_t kWidth = CoefficientTable::kPanelWidth;

/// One way to store a layer.
struct Form {
    TransferEncoding encoding = TransferEncoding::unorm8;  ///< of coefficients, or of weights
    std::size_t clusterCount = 0;                          ///< 0: by columns
    std::size_t componentCount = 0;

    auto key() const { return std::tuple(encoding, clusterCount, componentCount); }
};

/// Tries forms on a part of a layer.
class Trials {
  public:
    Trials(const TransferLayer& layer, const ClusterOptions& options, int threadCount,
           const ProgressCallback& progress)
        : layer_(layer),
          part_(takePart(layer, options.seed)),
          options_(options),
          errorWeights_(
              weighRows(options.light, rowLength(), layer.channelCount, layer.incidentBandCount)),
          threadCount_(threadCount),
          progress_(progress) {}

    std::size_t rowCount() const { return layer_.coefficients.rowCount(); }
    std::size_t rowLength() const { return layer_.coefficients.columnCount(); }

    /// The most clusters that are of use: with members enough for their components.
    std::size_t mostClusters(std::size_t componentCount) const {
        const std::size_t rowsEach = 2 * (1 + componentCount);
        return std::clamp<std::size_t>(part_.coefficients.rowCount() / rowsEach, 1, kMostClusters);
    }

    /// What a form takes at most.
    double bytes(const Form& form) const {
        const std::size_t width = form.clusterCount == 0 ? rowLength() : 1 + form.componentCount;
        return static_cast<double>(kWidth * CoefficientTable::countPanels(width) *
                                   bytesPerCoefficient(form.encoding)) +
               static_cast<double>(form.clusterCount) * bytesPerCluster(form.componentCount);
    }

    /// Of a cluster's vectors, over the receivers.
    double bytesPerCluster(std::size_t componentCount) const {
        return static_cast<double>((1 + componentCount) * rowLength() *
                                   bytesPerCoefficient(options_.basesEncoding)) /
               static_cast<double>(rowCount());
    }

    /// The error of a form on the part.
    double error(const Form& form) {
        const auto known = errors_.find(form.key());
        if (known != errors_.end()) return known->second;
        const double error =
            measure(store(part_, form, 0.0, kTrialIterations, trialProgress()), part_);
        errors_[form.key()] = error;
        return error;
    }

    /// Stores the layer itself.
    ///
    /// @param maxError  under which components are left out; 0: none
    CompressedLayer storeAll(const Form& form, double maxError) const {
        return store(layer_, form, maxError, options_.iterationCount, progress_);
    }

    double errorOf(const CompressedLayer& stored) const { return measure(stored, layer_); }

  private:
    static constexpr std::size_t kTrialIterations = 8;

    static TransferLayer takePart(const TransferLayer& layer, std::uint64_t seed) {
        constexpr std::size_t kMostRows = std::size_t{1} << 15;
        constexpr std::size_t kMostNumbers = 10'000'000;
        const CoefficientTable& all = layer.coefficients;
        const std::size_t rowCount = std::min(kMostRows, kMostNumbers / all.columnCount());
        const auto indices = drawIndices(all.rowCount(), rowCount, RandomStream(seed, 5));
        std::vector<float> rows(indices.size() * all.columnCount());
        readRows(all, indices, rows);
        return {layer.transport, layer.channelCount, makeTable(all.columnCount(), rows),
                layer.incidentBandCount};
    }

    double measure(const CompressedLayer& stored, const TransferLayer& truth) const {
        const CompressionError error = measureCompressionError(stored, truth, options_.light);
        return options_.light.empty() ? error.relativeRmse : error.seen;
    }

    /// The error as it is measured of transfer that is all lost.
    double wholeError() const {
        CompressedLayer nothing{.channelCount = part_.channelCount,
                                .incidentBandCount = part_.incidentBandCount};
        nothing.table.numbers =
            CoefficientTable(part_.coefficients.rowCount(), rowLength(), sizeof(float));
        return measure(nothing, part_);
    }

    CompressedLayer store(const TransferLayer& layer, const Form& form, double maxError,
                          std::size_t iterationCount, const ProgressCallback& progress) const {
        CompressedLayer stored{.transport = layer.transport,
                               .channelCount = layer.channelCount,
                               .incidentBandCount = layer.incidentBandCount};
        if (form.clusterCount == 0) {
            stored.table = quantiseTable(layer.coefficients, form.encoding);
            return stored;
        }
        ClusterOptions options = options_;
        options.clusterCount = form.clusterCount;
        options.componentCount = form.componentCount;
        options.iterationCount = std::min(options_.iterationCount, iterationCount);
        options.maxError = maxError > 0.0 ? maxError / wholeError() : 0.0;
        ClusteredTable clustered = compressClusters(layer.coefficients, errorWeights_, options,
                                                    form.encoding, threadCount_, progress);
        stored.table = std::move(clustered.table);
        stored.bases = std::move(clustered.bases);
        return stored;
    }

    /// Trials are a stage of their own, of which it is not known how many will be needed.
    ProgressCallback trialProgress() const {
        if (!progress_) return {};
        return [this](const Progress&) {
            const std::uint64_t done = errors_.size();
            return progress_({"choose", "trials", done, std::max<std::uint64_t>(12, done + 1)});
        };
    }

    const TransferLayer& layer_;
    TransferLayer part_;
    ClusterOptions options_;
    std::vector<float> errorWeights_;
    int threadCount_;
    const ProgressCallback& progress_;
    std::map<std::tuple<TransferEncoding, std::size_t, std::size_t>, double> errors_;
};

constexpr std::array<TransferEncoding, 3> kEncodings = {
    TransferEncoding::float32, TransferEncoding::unorm16, TransferEncoding::unorm8};

/// The widths that fill attributes, with all their components used: 3, 7, 11, …
std::vector<std::size_t> listComponentCounts(std::size_t rowLength) {
    std::vector<std::size_t> counts;
    for (std::size_t count = kWidth - 1; count < rowLength; count += kWidth)
        counts.push_back(count);
    if (counts.empty()) counts.push_back(rowLength);
    return counts;
}

/// What may be best for so many bytes. Of each encoding the forms with most components, and so few
/// clusters, are tried against those with fewer.
std::vector<Form> listFormsOfSize(const Trials& trials, double bytes) {
    constexpr std::size_t kTrialsEach = 4;
    std::vector<Form> forms;
    for (const TransferEncoding encoding : kEncodings) {
        const Form columns{encoding};
        if (trials.bytes(columns) <= bytes) forms.push_back(columns);
        if (encoding == TransferEncoding::float32) continue;
        std::vector<Form> clustered;
        for (const std::size_t count : listComponentCounts(trials.rowLength())) {
            Form form{encoding, 1, count};
            const double spare = bytes - trials.bytes(form);
            if (spare < 0.0) break;
            form.clusterCount = std::min(
                trials.mostClusters(count),
                1 + static_cast<std::size_t>(std::min(spare / trials.bytesPerCluster(count),
                                                      static_cast<double>(kMostClusters))));
            clustered.push_back(form);
        }
        const std::size_t first = clustered.size() - std::min(kTrialsEach, clustered.size());
        forms.insert(forms.end(), clustered.begin() + static_cast<std::ptrdiff_t>(first),
                     clustered.end());
    }
    return forms;
}

Form chooseForBytes(Trials& trials, double bytes) {
    const std::vector<Form> forms = listFormsOfSize(trials, bytes);
    if (forms.empty()) {
        const Form least{TransferEncoding::unorm8, 1, listComponentCounts(trials.rowLength())[0]};
        const auto leastBytes = static_cast<std::uint64_t>(std::ceil(trials.bytes(least)));
        throw Error(ErrorCode::invalidOption, "a layer does not fit in so few bytes a vertex", {},
                    "allow " + std::to_string(leastBytes));
    }
    const auto best = std::ranges::min_element(
        forms, [&](const Form& a, const Form& b) { return trials.error(a) < trials.error(b); });
    return *best;
}

/// The fewest clusters of a list that keep an error and take less than some bytes.
std::optional<Form> chooseClusterCount(Trials& trials, Form form, double maxError, double bytes,
                                       double& leastError) {
    constexpr std::array<std::size_t, 13> kCounts = {1,  2,  4,  8,   16,  24, 32,
                                                     48, 64, 96, 128, 192, 256};
    std::vector<Form> forms;
    for (const std::size_t count : kCounts) {
        form.clusterCount = count;
        if (count <= trials.mostClusters(form.componentCount) && trials.bytes(form) < bytes)
            forms.push_back(form);
    }
    if (forms.empty()) return std::nullopt;
    leastError = trials.error(forms.back());
    if (leastError > maxError) return std::nullopt;
    return *std::partition_point(forms.begin(), forms.end() - 1,
                                 [&](const Form& fewer) { return trials.error(fewer) > maxError; });
}

/// The form of fewest bytes that keeps an error in the trials.
Form chooseForError(Trials& trials, double maxError) {
    constexpr double kLeastGain = 0.9;  // more components lower the error to this part, or the
                                        // rounding of weights is what is left
    Form best{TransferEncoding::float32};
    for (const TransferEncoding encoding : {TransferEncoding::unorm16, TransferEncoding::unorm8})
        if (trials.error({encoding}) <= maxError) best = {encoding};
    for (const TransferEncoding encoding : {TransferEncoding::unorm8, TransferEncoding::unorm16}) {
        double lastError = std::numeric_limits<double>::infinity();
        for (const std::size_t count : listComponentCounts(trials.rowLength())) {
            double error = 0.0;
            const auto form = chooseClusterCount(trials, {encoding, 1, count}, maxError,
                                                 trials.bytes(best), error);
            if (form)
                best = *form;
            else if (error == 0.0 || error > kLeastGain * lastError)
                break;
            lastError = error;
        }
    }
    return best;
}

/// Stores what keeps an error, as it is measured of the result.
CompressedLayer storeForError(Trials& trials, double maxError) {
    constexpr double kForRounding = 0.9;  // what leaving components out may use of the error
    constexpr double kTighter = 0.97;
    constexpr int kAttempts = 4;
    double aim = maxError;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        const Form form = chooseForError(trials, aim);
        if (form.clusterCount > 0) {
            CompressedLayer adaptive = trials.storeAll(form, kForRounding * maxError);
            if (trials.errorOf(adaptive) <= maxError) return adaptive;
        }
        CompressedLayer stored = trials.storeAll(form, 0.0);
        const double error = trials.errorOf(stored);
        if (error <= maxError || form.encoding == TransferEncoding::float32) return stored;
        aim *= kTighter * maxError / error;
    }
    return trials.storeAll({TransferEncoding::float32}, 0.0);
}

}  // namespace

double countBytesPerReceiver(const CompressedLayer& layer) {
    const CoefficientTable& numbers = layer.table.numbers;
    return static_cast<double>(kWidth * numbers.panelCount() * numbers.elementBytes()) +
           sharedBytesPerReceiver(layer);
}

CompressedLayer compressToBudget(const TransferLayer& layer, const ClusterOptions& options,
                                 const CompressionBudget& budget, int threadCount,
                                 const ProgressCallback& progress) {
    PRT_ASSERT((budget.bytesPerReceiver > 0.0) != (budget.maxError > 0.0),
               "the bytes or the error are given");
    Trials trials(layer, options, threadCount, progress);
    if (budget.maxError > 0.0) return storeForError(trials, budget.maxError);
    return trials.storeAll(chooseForBytes(trials, budget.bytesPerReceiver), 0.0);
}

}  // namespace prt
