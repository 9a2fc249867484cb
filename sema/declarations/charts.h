// SPDX-License-Identifier: Apache-2.0
// Scheduling of charts (SFC). In: the context of the POU whose chart is scheduled. Out: the sections of its variables,
// in Project::made_sections.
#pragma once

#include "frontend/schedule/sfc_schedule.h"
#include "sema/context.h"

namespace rung::sema {

text::Charts chartsOf(const Context& context);
text::ChartContext chartContextOf(const Context& context, PouId pou);
// The variables of a chart, or of conditions that charts of actions use.
void declareChart(Context& context, PouId pou);

}  // namespace rung::sema
