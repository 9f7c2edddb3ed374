"""The mapping of clause 13: C++ declarations as data, each with its requirement and its element of the model."""
