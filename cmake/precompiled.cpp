// The precompiled headers of all libraries belong to this source (LsysTargets.cmake).
