# Writes the C++ that holds a page:   cmake -DPAGE=<index.html> -DSOURCE=<page_template.cpp> -P cmake/embed_page.cmake
set(text "")
if(PAGE)
    file(READ "${PAGE}" text)
endif()
file(WRITE "${SOURCE}"
    "#include \"apps/prt/page_template.h\"\n\nnamespace prt::cli {\n\nconst std::string_view kPageTemplate = R\"prt_page("
    "${text}" ")prt_page\";\n\n}  // namespace prt::cli\n")
