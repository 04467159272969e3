#include "prt/gpu/gpu_table.h"

#include "prt/gpu/gl_objects.h"

namespace prt {
namespace {

std::size_t panelBytes(const CoefficientTable& table) {
    return table.rowCount() * CoefficientTable::kPanelWidth * table.elementBytes();
}

}  // namespace

std::size_t gpuTableBytes(const CoefficientTable& table) {
    return table.panelCount() * panelBytes(table);
}

GlName uploadTable(const CoefficientTable& table) {
    GlName buffer = makeBuffer(gpuTableBytes(table), "transfer");
    // One panel at a time is in memory.
    for (std::size_t panel = 0; panel < table.panelCount(); ++panel) {
        writeBuffer(buffer, panel * panelBytes(table), table.panel(panel));
        table.releaseMemory();
    }
    return buffer;
}

}  // namespace prt
