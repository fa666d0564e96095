// SPDX-License-Identifier: MIT
// An empty source for the target whose precompiled headers all libraries reuse (LsysTargets.cmake).
