"""What clause 13 makes of a model: C++ declarations as data, each with its requirement and the element that it comes from."""
