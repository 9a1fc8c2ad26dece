// The headers precompiled for all tests need one unit of their own to be compiled with.
