// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SPECTRUM_SPECTRUM_CSV_H
#define SPECTRUM_SPECTRUM_CSV_H
// Spectra from text files: two columns "nm,value", nm ascending. The first line may be a header;
// empty lines and what follows # are ignored.

#include "spectrum/spectrum.h"

// Reads a table of at most 100000 knots. `name` stands for the file in messages, which have its
// line. Returns TRL_ERROR_INVALID for anything else than finite numbers in two columns.
TRL_MUST_USE trl_result spectrum_csv_parse(const trl_context *ctx, const char *text, size_t length,
                                           const char *name, struct spectrum *out);

#endif // SPECTRUM_SPECTRUM_CSV_H
